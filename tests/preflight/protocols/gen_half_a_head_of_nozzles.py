from opentrons.protocol_api import SINGLE, ALL

metadata = {"protocolName": "Cherry-picking with one nozzle of eight"}
requirements = {"robotType": "Flex", "apiLevel": "2.20"}


def run(protocol):
    tips = protocol.load_labware("opentrons_flex_96_tiprack_50ul", "C3")
    hits = protocol.load_labware("nest_96_wellplate_200ul_flat", "D1", "source plate")
    picked = protocol.load_labware("nest_96_wellplate_200ul_flat", "D2", "destination plate")
    protocol.load_trash_bin("A3")
    pipette = protocol.load_instrument("flex_8channel_50", "right")

    pipette.configure_nozzle_layout(style=SINGLE, start="A1", tip_racks=[tips])
    pipette.pick_up_tip()
    for source, target in [("A5", "A1"), ("C5", "B1")]:
        pipette.aspirate(10, hits[source])
        pipette.dispense(10, picked[target])
    pipette.drop_tip()
