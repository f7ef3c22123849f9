# expect: cell_treatment pass
"""Doxorubicin on A549."""
from opentrons import protocol_api
metadata = {"apiLevel": "2.14"}
# well, dose (uM); 0 = DMSO only
LAYOUT = [("B2", 0), ("B3", 0.1), ("B4", 1), ("B5", 10), ("C2", 0), ("C3", 0.1), ("C4", 1), ("C5", 10)]


def run(ctx: protocol_api.ProtocolContext):
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "A549")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    dmso, dox01, dox1, dox10 = rack.rows()[0][:4]
    source = {0: dmso, 0.1: dox01, 1: dox1, 10: dox10}
    for well, dose in LAYOUT:
        p300.transfer(50, source[dose], cells[well])
