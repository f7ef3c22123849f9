# expect: cell_treatment fail CELL-1
"""Microglia get fresh medium with or without LPS: "without LPS" names no drug, but the last mock well gets the other medium."""

from opentrons import protocol_api

metadata = {"protocolName": "Microglia, LPS overnight", "apiLevel": "2.14"}


def run(protocol: protocol_api.ProtocolContext):
    cells = protocol.load_labware("corning_24_wellplate_3.4ml_flat", "1")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "2")
    tips = protocol.load_labware("opentrons_96_tiprack_1000ul", "3")
    p1000 = protocol.load_instrument("p1000_single_gen2", "right", tip_racks=[tips])
    dmem_without_lps = trough["A1"]
    dmem_lps_20ng = trough["A2"]
    mock_wells = cells.columns()[0]
    stimulated_wells = cells.columns()[1]
    p1000.transfer(400, dmem_without_lps, mock_wells[:3], new_tip="always")
    p1000.transfer(400, dmem_lps_20ng, [*stimulated_wells, mock_wells[3]], new_tip="always")
