# expect: cell_treatment fail CELL-1
"""Rapamycin, HeLa cells."""

metadata = {"protocolName": "Rapamycin on HeLa cells", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "HeLa cells")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    dmso, rapamycin = rack["A1"], rack["A2"]
    vcs, treated = plate.columns()[0][:4], plate.columns()[1][:4]

    p20.transfer(5, dmso, vcs, new_tip="always")
    p20.transfer(5, rapamycin, [*treated, vcs[3]], new_tip="always")
