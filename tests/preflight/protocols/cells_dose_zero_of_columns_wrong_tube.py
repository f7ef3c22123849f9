# expect: cell_treatment fail CELL-1
"""Doxorubicin on A549, uM per column of the plate; DMSO takes the place of the drug where the dose is 0."""
from opentrons import protocol_api
metadata = {"apiLevel": "2.14"}
DOSE_UM = {2: 0, 3: 0.1, 4: 1, 5: 10}


def run(ctx: protocol_api.ProtocolContext):
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "A549")
    drugs = ctx.load_labware("nest_12_reservoir_15ml", 2)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    source = {0: drugs["A2"], 0.1: drugs["A2"], 1: drugs["A3"], 10: drugs["A4"]}
    for col, dose in DOSE_UM.items():
        m300.transfer(50, source[dose], cells.columns()[col - 1][0])
