"""A class of its own for a sticky liquid, with mixing, touching and air."""
from opentrons.protocol_api import SINGLE

metadata = {"protocolName": "the newest level for the Flex on 8.8"}
requirements = {"robotType": "Flex", "apiLevel": "2.27"}


def run(ctx):
    ctx.load_trash_bin("A3")
    tips = ctx.load_labware("opentrons_flex_96_filtertiprack_1000ul", "B2")
    plate = ctx.load_labware("nest_96_wellplate_2ml_deep", "D2")
    tubes = ctx.load_labware("opentrons_15_tuberack_nest_15ml_conical", "D3")
    m1000 = ctx.load_instrument("flex_8channel_1000", "left")
    sticky = ctx.get_liquid_class("glycerol_50")
    settings = sticky.get_for("flex_8channel_1000", tips)
    settings.dispense.mix.enabled = True
    settings.dispense.mix.repetitions = 2
    settings.dispense.mix.volume = 100
    settings.dispense.retract.touch_tip.enabled = True

    m1000.configure_nozzle_layout(style=SINGLE, start="H1", tip_racks=[tips])
    m1000.transfer_with_liquid_class(sticky, 150, tubes["A1"], plate["H4"], new_tip="always")
    m1000.pick_up_tip()
    m1000.aspirate(200, tubes["A2"], flow_rate=100)
    m1000.air_gap(20, in_place=True, flow_rate=50)
    m1000.dispense(220, plate["H5"], flow_rate=100)
    m1000.touch_tip(plate["H5"], mm_from_edge=1)
    m1000.blow_out(plate["H5"].top())
    m1000.drop_tip()
