"""The smallest guarded protocol for a Flex."""

from aegis_ot import guard

metadata = {"protocolName": "Hello, Flex"}
requirements = {"robotType": "Flex", "apiLevel": "2.20"}


@guard
def run(protocol):
    tips = protocol.load_labware("opentrons_flex_96_tiprack_1000ul", "B2")
    dye = protocol.load_labware("nest_12_reservoir_15ml", "C1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "C2")
    protocol.load_trash_bin("A3")
    pipette = protocol.load_instrument("flex_1channel_1000", "left", tip_racks=[tips])

    pipette.transfer(300, dye["A1"], plate.columns()[0], new_tip="always")
