metadata = {"protocolName": "plates and tips from stackers"}
requirements = {"robotType": "Flex", "apiLevel": "2.25"}


def run(ctx):
    chute = ctx.load_waste_chute()
    plates = ctx.load_module("flexStackerModuleV1", "C4")
    racks = ctx.load_module("flexStackerModuleV1", "B4")
    plates.set_stored_labware("nest_96_wellplate_200ul_flat", count=3)
    racks.set_stored_labware("opentrons_flex_96_tiprack_200ul", count=3)
    res = ctx.load_labware("nest_12_reservoir_15ml", "C1")
    m1000 = ctx.load_instrument("flex_8channel_1000", "left")
    m1000.trash_container = chute

    for number in range(2):
        plate, tips = plates.retrieve(), racks.retrieve()
        ctx.move_labware(plate, "C2", use_gripper=True)
        ctx.move_labware(tips, "B2", use_gripper=True)
        m1000.tip_racks = [tips]
        m1000.pick_up_tip(tips["A1"])
        m1000.aspirate(60, res["A1"])
        m1000.dispense(60, plate.columns()[number][0])
        m1000.drop_tip()
        ctx.move_labware(tips, chute, use_gripper=True)
        ctx.move_labware(plate, plates, use_gripper=True)
        plates.store()
