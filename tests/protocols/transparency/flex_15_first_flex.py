from opentrons import protocol_api

metadata = {"protocolName": "first Flex protocol"}
requirements = {"robotType": "Flex", "apiLevel": "2.15"}


def run(ctx: protocol_api.ProtocolContext):
    tips50 = ctx.load_labware("opentrons_flex_96_tiprack_50ul", "C1")
    tips1000 = ctx.load_labware("opentrons_flex_96_tiprack_1000ul", "C2")
    plate = ctx.load_labware("nest_96_wellplate_2ml_deep", "D1")
    small = ctx.load_labware("opentrons_96_wellplate_200ul_pcr_full_skirt", "D2")
    res = ctx.load_labware("nest_12_reservoir_15ml", "D3")
    p50 = ctx.load_instrument("flex_1channel_50", "left", tip_racks=[tips50])
    p1000 = ctx.load_instrument("flex_1channel_1000", "right", tip_racks=[tips1000])

    p1000.transfer(600, res["A1"], plate.columns()[0], new_tip="always")
    p50.configure_for_volume(3)
    p50.pick_up_tip()
    for well in small.columns()[0]:
        p50.aspirate(3, res["A2"])
        p50.dispense(3, well, push_out=2)
    p50.drop_tip()
    p50.configure_for_volume(40)
    p50.distribute(12, plate["A1"], small.columns()[1], disposal_volume=2)
    ctx.move_labware(small, "B2", use_gripper=True)
    p1000.consolidate(100, plate.columns()[0], plate["A12"], mix_after=(2, 300))
