# expect: cell_treatment pass
"""Columns of a reservoir and of the plate, each under a heading of its own.

Reservoir:
  column 1: vehicle (0.1 % DMSO)
  column 2: doxorubicin 1 uM
Plate:
  column 1: vehicle control
  columns 2-6: doxorubicin
"""
metadata = {"apiLevel": "2.13"}


def run(ctx):
    res = ctx.load_labware("nest_12_reservoir_15ml", 3)
    hela = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "HeLa")
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    m = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    m.transfer(20, res.wells()[0], hela.rows()[0][0], new_tip="always")
    m.transfer(20, res.wells()[1], hela.rows()[0][1:6], new_tip="always")
