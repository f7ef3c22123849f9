# expect: cell_treatment fail CELL-1
metadata = {"protocolName": "HCC827, viability after 72 h", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "HCC827")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    saline, gefitinib, osimertinib = rack["A1"], rack["A2"], rack["A3"]
    controls, left, right = (column[:6] for column in plate.columns()[:3])

    p20.transfer(4, saline, controls, new_tip="always")
    p20.transfer(4, gefitinib, left, new_tip="always")
    p20.transfer(4, osimertinib, [*right, controls[5]], new_tip="always")
