from opentrons.protocol_api import SINGLE

metadata = {"protocolName": "looks for liquid, uses single nozzles"}
requirements = {"robotType": "Flex", "apiLevel": "2.20"}


def run(ctx):
    ctx.load_trash_bin("A1")
    tips = ctx.load_labware("opentrons_flex_96_filtertiprack_200ul", "B3")
    single_tips = ctx.load_labware("opentrons_flex_96_filtertiprack_200ul", "B2")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", "D2")
    res = ctx.load_labware("nest_12_reservoir_15ml", "D3")
    m1000 = ctx.load_instrument("flex_8channel_1000", "right", tip_racks=[tips])
    blue = ctx.define_liquid("blue", "", "#0000ff")
    res["A1"].load_liquid(blue, 8000)
    res["A2"].load_liquid(blue, 8000)

    m1000.pick_up_tip()
    ctx.comment(f"liquid: {m1000.detect_liquid_presence(res['A1'])}")
    m1000.require_liquid_presence(res["A1"])
    m1000.aspirate(120, res["A1"])
    m1000.dispense(120, plate["A1"])
    m1000.drop_tip()
    m1000.pick_up_tip()
    try:
        height = m1000.measure_liquid_height(res["A2"])
        ctx.comment(f"height {height}")
    except Exception as error:
        ctx.comment(type(error).__name__)
    m1000.drop_tip()

    m1000.configure_nozzle_layout(style=SINGLE, start="H1", tip_racks=[single_tips])
    m1000.liquid_presence_detection = True
    for well in plate.columns()[5][:3]:
        m1000.pick_up_tip()
        m1000.aspirate(60, res["A1"])
        m1000.dispense(60, well.top(-2))
        m1000.drop_tip()
