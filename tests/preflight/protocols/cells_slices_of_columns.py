# expect: cell_treatment pass
"""Dose response on HeLa."""
from opentrons import protocol_api
metadata = {"apiLevel": "2.14"}
UNTREATED = slice(0, 1)
VEHICLE = slice(1, 3)
DRUG = slice(3, 10)


def run(ctx: protocol_api.ProtocolContext):
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "HeLa")
    trough = ctx.load_labware("nest_12_reservoir_15ml", 2)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    dmso_medium, staurosporine = trough["A1"], trough["A2"]
    for col in cells.columns()[VEHICLE]:
        m300.transfer(50, dmso_medium, col[0])
    for col in cells.columns()[DRUG]:
        m300.transfer(50, staurosporine, col[0])
