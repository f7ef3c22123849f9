# expect: bradford pass BRD-2!
metadata = {"protocolName": "Bradford, wheat gluten", "apiLevel": "2.13"}


def run(ctx):
    label = "prep block: curve col 1, samples col 2-3"
    block = ctx.load_labware("nest_96_wellplate_2ml_deep", 1, label)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2)
    trough = ctx.load_labware("nest_1_reservoir_195ml", 3, "Bradford reagent")
    t20 = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    t300 = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[t300])

    p20.transfer(5, block.columns()[0], plate.columns()[0], new_tip="always")
    p20.transfer(5, block.columns()[1], plate.columns()[1], new_tip="always")
    p20.transfer(5, block.columns()[2], plate.columns()[2], new_tip="always")
    for head in plate.rows()[0][:3]:
        m300.transfer(195, trough["A1"], head, mix_after=(3, 100))
