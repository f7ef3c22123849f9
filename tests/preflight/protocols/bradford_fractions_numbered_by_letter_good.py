# expect: bradford pass BRD-2!
"""Protein in goat milk.

On the plate
H1-H6 = milk fractions F1-F6
"""

metadata = {"protocolName": "Bradford, milk", "apiLevel": "2.13"}


def run(ctx):
    bsa = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1, "BSA standards")
    milk = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "milk")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3, "plate")
    trough = ctx.load_labware("nest_1_reservoir_195ml", 4, "Bradford reagent")
    t20 = ctx.load_labware("opentrons_96_filtertiprack_20ul", 5)
    t300 = ctx.load_labware("opentrons_96_filtertiprack_200ul", 6)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    upper, lower = plate.rows()[5][:6], plate.rows()[7][:6]

    p20.pick_up_tip()
    for tube, well in zip(bsa.wells(), upper):
        p20.transfer(5, tube, well, new_tip="never")
    p20.drop_tip()
    p20.transfer(5, milk.wells()[:6], lower, new_tip="always")
    for well in upper + lower:
        p300.transfer(195, trough["A1"], well, mix_after=(3, 100))
