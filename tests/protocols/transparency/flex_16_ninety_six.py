from opentrons.protocol_api import ALL, COLUMN

metadata = {"protocolName": "96 channels, then one column of them"}
requirements = {"robotType": "Flex", "apiLevel": "2.16"}


def run(ctx):
    ctx.load_trash_bin("A3")
    adapter = ctx.load_adapter("opentrons_flex_96_tiprack_adapter", "B2")
    tips = adapter.load_labware("opentrons_flex_96_tiprack_1000ul")
    bare = ctx.load_labware("opentrons_flex_96_tiprack_50ul", "C1")
    plate = ctx.load_labware("nest_96_wellplate_2ml_deep", "D2")
    other = ctx.load_labware("nest_96_wellplate_2ml_deep", "C3")
    res = ctx.load_labware("nest_1_reservoir_195ml", "D1")
    p96 = ctx.load_instrument("flex_96channel_1000")

    p96.configure_nozzle_layout(style=ALL, tip_racks=[tips])
    p96.pick_up_tip()
    p96.aspirate(300, res["A1"])
    p96.air_gap(20)
    p96.dispense(320, plate["A1"])
    p96.mix(2, 150, plate["A1"])
    p96.blow_out(plate["A1"].top())
    p96.return_tip()
    p96.reset_tipracks()

    p96.configure_nozzle_layout(style=COLUMN, start="A12", tip_racks=[bare])
    for column in (0, 3):
        p96.pick_up_tip()
        p96.aspirate(30, plate.columns()[column][0])
        p96.dispense(30, other.columns()[column][0])
        p96.drop_tip()
