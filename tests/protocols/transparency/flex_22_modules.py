metadata = {"protocolName": "modules of the Flex"}
requirements = {"robotType": "Flex", "apiLevel": "2.22"}


def run(ctx):
    chute = ctx.load_waste_chute()
    tc = ctx.load_module("thermocyclerModuleV2")
    hs = ctx.load_module("heaterShakerModuleV1", "D1")
    mag = ctx.load_module("magneticBlockV1", "C3")
    temp = ctx.load_module("temperature module gen2", "C1")
    cold = temp.load_adapter("opentrons_96_well_aluminum_block").load_labware("opentrons_96_wellplate_200ul_pcr_full_skirt")
    deep = hs.load_adapter("opentrons_96_deep_well_adapter").load_labware("nest_96_wellplate_2ml_deep")
    tips = ctx.load_labware("opentrons_flex_96_filtertiprack_50ul", "B2")
    tips200 = ctx.load_labware("opentrons_flex_96_filtertiprack_200ul", "A2")
    m50 = ctx.load_instrument("flex_8channel_50", "left", tip_racks=[tips])
    p1000 = ctx.load_instrument("flex_1channel_1000", "right", tip_racks=[tips200])
    m50.trash_container = chute
    p1000.trash_container = chute

    tc.open_lid()
    hs.close_labware_latch()
    temp.set_temperature(4)
    p1000.transfer(150, deep.columns()[0][:3], deep.columns()[1][:3], new_tip="always")
    m50.transfer(20, deep["A1"], cold.rows()[0][:4], mix_after=(2, 10))
    hs.set_and_wait_for_shake_speed(500)
    ctx.delay(seconds=20)
    hs.deactivate_shaker()
    hs.open_labware_latch()
    ctx.move_labware(deep, mag, use_gripper=True)
    m50.pick_up_tip()
    m50.aspirate(40, deep["A2"].bottom(2))
    m50.dispense(40, chute)
    m50.drop_tip()
    ctx.move_labware(cold, tc, use_gripper=True)
    tc.close_lid()
    tc.set_block_temperature(72, hold_time_seconds=30, block_max_volume=20)
    tc.open_lid()
    m50.transfer(10, cold["A1"], deep["A12"], touch_tip=True)
