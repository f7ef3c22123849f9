# expect: cell_treatment pass CELL-1!
"""Celecoxib, chondrocytes, eight wells of each.

Columns: 1 no treatment | 2 vehicle | 3..6 dose 1..4
"""

metadata = {"protocolName": "Celecoxib, chondrocytes", "apiLevel": "2.13"}


def run(ctx):
    deep = ctx.load_labware("nest_12_reservoir_15ml", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "chondrocytes")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 3)
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[tips])
    heads = plate.rows()[0]
    vehicle, drug = deep["A1"], deep.wells()[2:6]

    m300.transfer(30, vehicle, heads[1])
    for trough, head in zip(drug, heads[2:]):
        m300.transfer(30, trough, head)
