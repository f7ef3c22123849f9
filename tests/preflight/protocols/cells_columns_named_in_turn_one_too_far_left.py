# expect: cell_treatment warn CELL-1
"""Rotenone, iPSC neurons.

columns 1-4: untreated, vehicle, low dose, high dose
"""

metadata = {"protocolName": "Rotenone", "apiLevel": "2.13"}


def run(ctx):
    trough = ctx.load_labware("nest_12_reservoir_15ml", 1)
    neurons = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "neurons")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 3)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    vehicle, rotenone_low, rotenone_high = trough.wells()[:3]
    heads = neurons.rows()[0]

    m300.transfer(25, vehicle, heads[1])
    m300.transfer(25, rotenone_low, heads[2])
    m300.transfer(25, rotenone_high, [heads[3], heads[0]])
