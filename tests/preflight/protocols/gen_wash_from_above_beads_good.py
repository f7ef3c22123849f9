# expect: generic pass
"""Bead wash: the ethanol falls from above the columns, with one set of tips."""

metadata = {"protocolName": "Bead wash", "apiLevel": "2.13"}


def run(ctx):
    magnet = ctx.load_module("magnetic module gen2", "1")
    plate = magnet.load_labware("nest_96_wellplate_2ml_deep", "lysate samples on beads")
    trough = ctx.load_labware("nest_12_reservoir_15ml", "2")
    liquid_waste = ctx.load_labware("nest_1_reservoir_195ml", "3")["A1"]
    racks = [ctx.load_labware("opentrons_96_filtertiprack_200ul", slot) for slot in ("5", "6")]
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=racks)
    ethanol = trough["A6"]
    columns = plate.rows()[0][:4]
    magnet.engage(height_from_base=6)
    for column in columns:
        m300.transfer(150, column, liquid_waste)
    m300.pick_up_tip()
    for column in columns:
        m300.aspirate(190, ethanol)
        m300.dispense(190, column.top(1))
    m300.drop_tip()
    for column in columns:
        m300.transfer(190, column, liquid_waste)
