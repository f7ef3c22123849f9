from opentrons.protocol_api import ALL, PARTIAL_COLUMN, SINGLE

metadata = {"protocolName": "some nozzles of eight"}
requirements = {"robotType": "Flex", "apiLevel": "2.20"}


def run(ctx):
    ctx.load_trash_bin("A3")
    racks = [ctx.load_labware("opentrons_flex_96_tiprack_200ul", slot) for slot in ("B1", "B2", "B3")]
    plate = ctx.load_labware("nest_96_wellplate_200ul_flat", "D2")
    res = ctx.load_labware("nest_12_reservoir_15ml", "D3")
    m1000 = ctx.load_instrument("flex_8channel_1000", "right")

    m1000.configure_nozzle_layout(style=PARTIAL_COLUMN, start="H1", end="E1", tip_racks=[racks[0]])
    for name in ("D1", "H2"):
        m1000.pick_up_tip()
        m1000.aspirate(50, res["A1"])
        m1000.dispense(50, plate[name])
        m1000.blow_out(plate[name].top())
        m1000.drop_tip()
    m1000.configure_nozzle_layout(style=SINGLE, start="H1", tip_racks=[racks[1]])
    m1000.transfer(30, res["A2"], [plate["C4"], plate["D4"]], new_tip="always", touch_tip=True)
    m1000.configure_nozzle_layout(style=ALL, tip_racks=[racks[2]])
    m1000.distribute(20, res["A3"], plate.rows()[0][5:8], disposal_volume=10)
