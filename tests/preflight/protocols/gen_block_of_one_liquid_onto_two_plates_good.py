# expect: generic pass
from opentrons import protocol_api

metadata = {"protocolName": "Stamp of a diluent block onto two plates", "apiLevel": "2.13"}


def run(ctx):
    src = ctx.load_labware("nest_12_reservoir_15ml", 1)
    deep = ctx.load_labware("nest_96_wellplate_2ml_deep", 2)
    p1 = ctx.load_labware("corning_96_wellplate_360ul_flat", 3)
    p2 = ctx.load_labware("corning_96_wellplate_360ul_flat", 6)
    tips = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (4, 5)]
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=tips)

    # every well of the deep block is the same 20 mM Tris; it was filled by hand
    m300.pick_up_tip()
    for i in range(12):
        m300.transfer(100, deep.columns()[i][0], [p1.columns()[i][0], p2.columns()[i][0]], new_tip="never")
    m300.drop_tip()
