# expect: cell_treatment pass
"""TNF on all wells, then inhibitor doses."""
from opentrons import protocol_api
metadata = {"apiLevel": "2.14"}
INHIBITOR_NM = {"B2": 0, "B3": 1, "B4": 10, "B5": 100, "C2": 0, "C3": 1, "C4": 10, "C5": 100}
INHIBITOR_TUBE = {0: "A1", 1: "A2", 10: "A3", 100: "A4"}


def run(ctx: protocol_api.ProtocolContext):
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "A549")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tnf = rack["D1"]
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    for well in INHIBITOR_NM:
        p300.transfer(50, tnf, cells[well])
    for well, nm in INHIBITOR_NM.items():
        p300.transfer(50, rack[INHIBITOR_TUBE[nm]], cells[well])
