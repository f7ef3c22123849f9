# expect: generic pass
"""A 24-well plate alone says little: colours are combined in it."""

from opentrons import protocol_api

metadata = {"protocolName": "Colour mixing demo", "apiLevel": "2.14"}


def run(protocol: protocol_api.ProtocolContext):
    plate = protocol.load_labware("corning_24_wellplate_3.4ml_flat", "1")
    rack = protocol.load_labware("opentrons_6_tuberack_falcon_50ml_conical", "2")
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "3")
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
    water = rack["A1"]
    sources = [rack["B1"], rack["B2"], rack["B3"]]
    p300.transfer(200, water, plate.wells()[:6], new_tip="once")
    for column, source in enumerate(sources):
        p300.transfer(100, source, plate.columns()[column][:2], new_tip="always")
