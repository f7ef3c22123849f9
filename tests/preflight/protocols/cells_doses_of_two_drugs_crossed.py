# expect: cell_treatment pass
"""Checkerboard: drug A along columns, drug B along rows, A549."""
from opentrons import protocol_api
metadata = {"apiLevel": "2.14"}
DOSES_A = {2: 0, 3: 0.1, 4: 1, 5: 10}
DOSES_B = {"B": 0, "C": 5, "D": 50, "E": 500}


def run(ctx: protocol_api.ProtocolContext):
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "A549")
    a = ctx.load_labware("nest_12_reservoir_15ml", 2, "drug A dilutions")
    b = ctx.load_labware("nest_12_reservoir_15ml", 4, "drug B dilutions")
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    m300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    for i, (col, dose) in enumerate(DOSES_A.items()):
        for row in DOSES_B:
            m300.transfer(50, a.wells()[i], cells[f"{row}{col}"])
    for i, (row, dose) in enumerate(DOSES_B.items()):
        for col in DOSES_A:
            m300.transfer(50, b.wells()[i], cells[f"{row}{col}"])
