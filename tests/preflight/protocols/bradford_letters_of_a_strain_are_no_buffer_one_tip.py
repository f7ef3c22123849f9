# expect: bradford fail BRD-2
"""Bradford of tuberculosis isolates (tb). BSA standards: rack A1-A4, 0, 0.5, 1, 2 mg/ml."""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2)
    trough = ctx.load_labware("nest_1_reservoir_195ml", 3, "Coomassie reagent")
    t20 = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    t300 = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    tb = rack.rows()[3][:5]
    first, second = plate.rows()[0][:4], plate.rows()[1][:5]

    p20.transfer(5, rack.rows()[0][:4], first, new_tip="always")
    p20.transfer(5, tb, second, new_tip="once")
    for well in first + second:
        p300.transfer(245, trough["A1"], well, mix_after=(3, 120))
