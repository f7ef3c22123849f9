# expect: bradford pass BRD-2!
"""Bradford of four column fractions. BSA standards: rack A1-A5, 0, 0.25, 0.5, 1 and 2 mg/ml."""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2)
    trough = ctx.load_labware("nest_1_reservoir_195ml", 3, "Coomassie reagent")
    t20 = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    t300 = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    used = plate.columns()[0][:5] + plate.columns()[1][:4]

    p20.transfer(5, rack.rows()[0][:5], plate.columns()[0][:5], new_tip="always")
    p20.transfer(5, rack.rows()[2][:4], plate.columns()[1][:4], new_tip="always")
    for well in used:
        p300.transfer(245, trough["A1"], well, mix_after=(3, 120))
