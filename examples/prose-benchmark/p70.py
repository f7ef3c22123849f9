"""Protein of the column fractions.

Vial       V1    V2   V3   V4   V5
mg/ml     1.6   0.8  0.4  0.1  0.05
"""

metadata = {"apiLevel": "2.14", "protocolName": "fractions, Coomassie"}
TUBE = {"V1": "B1", "V2": "B2", "V3": "B3", "V4": "B4", "V5": "B5"}
ORDER = ("V5", "V3", "V4", "V2", "V1")


def run(ctx):
    bsa = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4, "BSA standards")
    fractions = ctx.load_labware("nest_96_wellplate_200ul_flat", 5, "fractions")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    dye = ctx.load_labware("nest_1_reservoir_195ml", 3, "Coomassie")["A1"]
    small = ctx.load_labware("opentrons_96_filtertiprack_20ul", 7)
    large = ctx.load_labware("opentrons_96_filtertiprack_200ul", 8)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[large])

    p20.pick_up_tip()
    for number, standard in enumerate(ORDER):
        p20.aspirate(10, bsa[TUBE[standard]])
        p20.dispense(10, plate.columns()[0][number])
    p20.drop_tip()
    for fraction, well in zip(fractions.columns()[0], plate.columns()[1]):
        p20.transfer(10, fraction, well)
    for well in plate.columns()[0][:5] + plate.columns()[1]:
        p300.transfer(200, dye, well, new_tip="always", mix_after=(3, 100))
