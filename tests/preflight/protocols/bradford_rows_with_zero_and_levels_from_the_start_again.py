# expect: bradford fail BRD-1
"""Lowry of whey fractions.

rows C, D : BSA 0, 0.2, 0.4, 0.8, 1.6 mg/mL in columns 2-6
rows F, G : whey fraction 1-5, columns 2-6
"""

metadata = {"apiLevel": "2.12", "protocolName": "Lowry, whey"}


def run(ctx):
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1, "BSA")
    whey = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "samples")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3)
    reagent = ctx.load_labware("nest_1_reservoir_195ml", 5, "Lowry reagent")["A1"]
    small = ctx.load_labware("opentrons_96_filtertiprack_20ul", 8)
    large = ctx.load_labware("opentrons_96_filtertiprack_200ul", 9)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[large])

    p20.pick_up_tip()
    for row in "CD":
        for i in range(5):
            p20.aspirate(15, tubes.columns()[i][0])
            p20.dispense(15, plate[f"{row}{i + 2}"])
    p20.drop_tip()
    for i in range(5):
        p20.transfer(15, whey.columns()[i][0], [plate[f"F{i + 2}"], plate[f"G{i + 2}"]])
    for row in "CDFG":
        for i in range(5):
            p300.transfer(150, reagent, plate[f"{row}{i + 2}"], new_tip="always", mix_after=(2, 90))
