metadata = {"protocolName": "lids, a plate in the trash"}
requirements = {"robotType": "Flex", "apiLevel": "2.23"}


def run(ctx):
    trash = ctx.load_trash_bin("A3")
    tips = ctx.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", "C2", lid="corning_96_wellplate_360ul_lid")
    res = ctx.load_labware("nest_12_reservoir_15ml", "C1")
    riser = ctx.load_adapter("opentrons_flex_deck_riser", "D1")
    lids = ctx.load_lid_stack("opentrons_tough_pcr_auto_sealing_lid", riser, 2)
    pcr = ctx.load_labware("opentrons_96_wellplate_200ul_pcr_full_skirt", "D2")
    p1000 = ctx.load_instrument("flex_1channel_1000", "left", tip_racks=[tips])

    ctx.move_lid(plate, "D3", use_gripper=True)
    p1000.transfer(80, res["A1"], plate.columns()[0][:3], new_tip="always")
    ctx.move_lid("D3", plate, use_gripper=True)
    p1000.transfer(20, res["A2"], pcr.columns()[0][:3], new_tip="once")
    ctx.move_lid(lids, pcr, use_gripper=True)
    ctx.move_lid(pcr, trash, use_gripper=True)
    p1000.transfer(15, res["A3"], pcr["A4"])
