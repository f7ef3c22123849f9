metadata = {"protocolName": "waste chute, trash bin, gripper"}
requirements = {"robotType": "Flex", "apiLevel": "2.16"}


def run(ctx):
    chute = ctx.load_waste_chute()
    trash = ctx.load_trash_bin("A3")
    tips = ctx.load_labware("opentrons_flex_96_tiprack_200ul", "B1")
    plates = [ctx.load_labware("corning_96_wellplate_360ul_flat", slot) for slot in ("C1", "C2")]
    res = ctx.load_labware("nest_12_reservoir_15ml", "B2")
    m1000 = ctx.load_instrument("flex_8channel_1000", "left", tip_racks=[tips])

    m1000.pick_up_tip()
    m1000.aspirate(150, res["A1"])
    m1000.dispense(50, plates[0]["A1"])
    m1000.dispense(50, trash)
    m1000.dispense(50, chute)
    m1000.blow_out(chute)
    m1000.drop_tip(chute)
    m1000.trash_container = chute
    m1000.transfer(100, res["A2"], plates[1].rows()[0][:3], new_tip="always", blow_out=True, blowout_location="trash")
    m1000.trash_container = trash
    m1000.pick_up_tip()
    m1000.mix(2, 80, plates[1]["A1"])
    m1000.drop_tip()
    ctx.move_labware(plates[0], chute, use_gripper=True)
    ctx.move_labware(plates[1], "C1", use_gripper=True, pick_up_offset={"x": 0, "y": 0, "z": 1})
    m1000.pick_up_tip()
    m1000.aspirate(40, plates[1]["A2"])
    m1000.dispense(40, plates[1]["A5"])
    m1000.return_tip()
