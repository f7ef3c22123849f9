# expect: cell_treatment pass CELL-1!
"""Hepatocytes with two candidates. Plate: A1-D1 vehicle control."""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    liver = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "hepatocytes")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    dmso, hx7, hx9 = rack["A1"], rack["A2"], rack["A3"]

    p20.transfer(8, dmso, liver.columns()[0][:4], new_tip="always")
    p20.transfer(8, hx7, liver.columns()[1][:4], new_tip="always")
    p20.transfer(8, hx9, liver.columns()[2][:4], new_tip="always")
