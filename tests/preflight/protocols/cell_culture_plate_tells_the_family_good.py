# expect: cell_treatment pass
"""Nothing says what grows here: the 12-well plate tells."""

from opentrons import protocol_api

metadata = {"protocolName": "AMPK inhibitor titration", "apiLevel": "2.14"}

DMSO_WELLS = ["A1", "B1", "C1"]
WITH_P = ["A2", "B2", "C2"]
WITH_Q = ["A3", "B3", "C3"]


def run(protocol: protocol_api.ProtocolContext):
    dish = protocol.load_labware("corning_12_wellplate_6.9ml_flat", "1")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "3")
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    dmso_tube = rack["A1"]
    tube_p, tube_q = rack["B1"], rack["B2"]
    for well in DMSO_WELLS:
        p20.transfer(6, dmso_tube, dish[well], new_tip="always")
    for well in WITH_P:
        p20.transfer(6, tube_p, dish[well], new_tip="always")
    for well in WITH_Q:
        p20.transfer(6, tube_q, dish[well], new_tip="always")
