# expect: cell_treatment warn CELL-3
"""Organoids. Rack: tubes A1-A3: medium / DMSO / nutlin-3a. Plate: column 1 vehicle control."""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "organoid cells")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 3)
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    one, two, three = rack.rows()[0][:3]
    left, right = plate.columns()[0][:4], plate.columns()[1][:4]

    pip.transfer(80, one, left + right, new_tip="always")
    pip.pick_up_tip()
    pip.transfer(20, three, right, new_tip="never")
    pip.transfer(20, two, left, new_tip="never")
    pip.drop_tip()
