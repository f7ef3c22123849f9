# expect: cell_treatment fail CELL-1
"""The wells of a plate as sets: what is in neither set of controls is to be treated: here all are."""

from opentrons import protocol_api

metadata = {"protocolName": "Sorafenib on Huh-7", "apiLevel": "2.14"}

NOTHING_ADDED = {"A1", "B1", "C1", "D1"}
DMSO = {"A2", "B2", "C2", "D2"}


def run(protocol: protocol_api.ProtocolContext):
    plate = protocol.load_labware("corning_24_wellplate_3.4ml_flat", "1")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "3")
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    solvent, sorafenib = rack["A1"], rack["A2"]
    treated = set(plate.wells_by_name()) - DMSO
    for name in sorted(DMSO):
        p20.transfer(5, solvent, plate[name], new_tip="always")
    for name in sorted(treated):
        p20.transfer(5, sorafenib, plate[name], new_tip="always")
