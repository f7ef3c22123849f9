# expect: cell_treatment pass CELL-2!
"""Irinotecan, spheroids, column 1 with etoposide.

Cells: column 2 vehicle control
Vehicle everywhere except column 1
"""

metadata = {"protocolName": "Irinotecan", "apiLevel": "2.13"}


def run(ctx):
    trough = ctx.load_labware("nest_12_reservoir_15ml", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "spheroid cells")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 3)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    dmso, irinotecan, etoposide = trough.wells()[:3]
    heads = plate.rows()[0]

    m300.transfer(20, etoposide, heads[0])
    m300.transfer(20, dmso, heads[1])
    for head in heads[2:6]:
        m300.transfer(20, irinotecan, head)
