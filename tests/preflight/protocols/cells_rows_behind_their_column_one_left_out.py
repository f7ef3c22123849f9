# expect: cell_treatment warn CELL-2
"""SH-SY5Y on the inner wells, staurosporine in A11 and H11.

col 11: vehicle control, rows B-G, gets the DMF
"""

metadata = {"protocolName": "Neurotoxicity", "apiLevel": "2.13"}


def run(ctx):
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "SH-SY5Y cells")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    dmf, mpp, staurosporine = tubes["D1"], tubes["D2"], tubes["D3"]

    p20.transfer(6, dmf, plate.columns()[10][1:6], new_tip="always")
    for column in plate.columns()[1:4]:
        p20.transfer(6, mpp, column[1:7], new_tip="always")
    p20.transfer(6, staurosporine, [plate["A11"], plate["H11"]], new_tip="always")
