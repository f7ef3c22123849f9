from opentrons.protocol_api import ALL, ROW, SINGLE

metadata = {"protocolName": "rows and single nozzles of 96, waste chute"}
requirements = {"robotType": "Flex", "apiLevel": "2.20"}


def run(ctx):
    chute = ctx.load_waste_chute()
    bare = ctx.load_labware("opentrons_flex_96_tiprack_1000ul", "B1")
    adapter = ctx.load_adapter("opentrons_flex_96_tiprack_adapter", "A2")
    full = adapter.load_labware("opentrons_flex_96_tiprack_1000ul")
    plate = ctx.load_labware("nest_96_wellplate_2ml_deep", "C3")
    res = ctx.load_labware("nest_1_reservoir_195ml", "D2")
    p96 = ctx.load_instrument("flex_96channel_1000", "left")

    p96.configure_nozzle_layout(style=ROW, start="H1", tip_racks=[bare])
    for name in ("A1", "B1"):
        p96.pick_up_tip()
        p96.aspirate(100, res["A1"])
        p96.dispense(100, plate[name])
        p96.drop_tip()
    p96.configure_nozzle_layout(style=SINGLE, start="H12", tip_racks=[bare])
    p96.pick_up_tip()
    p96.aspirate(40, plate["H1"])
    p96.dispense(40, plate["F6"])
    p96.drop_tip()
    p96.configure_nozzle_layout(style=ALL, tip_racks=[full])
    p96.pick_up_tip()
    p96.aspirate(200, res["A1"])
    p96.dispense(150, plate["A1"].top(-5))
    p96.dispense(50, chute)
    p96.blow_out(chute)
    p96.drop_tip()
    ctx.move_labware(full, chute, use_gripper=True)
    ctx.move_labware(plate, "B2", use_gripper=True)
