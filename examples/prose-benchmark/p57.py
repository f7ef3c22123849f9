"""Bortezomib against RPMI-8226. The cells sit in columns 3-9 of the assay plate."""

from opentrons import protocol_api

metadata = {"protocolName": "Bortezomib, RPMI-8226"}
requirements = {"robotType": "OT-2", "apiLevel": "2.15"}

# Dose block:
#   drug columns 4-8, decreasing from left to right
#   vehicle column 2


def run(protocol: protocol_api.ProtocolContext):
    block = protocol.load_labware("nest_96_wellplate_2ml_deep", "4", "dose block")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", "7", "RPMI-8226 cells")
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", "10")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    def give(column, into):
        for well in cells.columns()[into][:6]:
            p300.transfer(20, block[f"A{column}"], well, new_tip="never")

    p300.pick_up_tip()
    give(2, 8)
    for step, column in enumerate([8, 7, 6, 5, 4]):
        give(column, 7 - step)
    p300.drop_tip()
