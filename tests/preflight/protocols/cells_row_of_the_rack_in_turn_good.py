# expect: cell_treatment pass CELL-3!
"""Colchicine, hepatocytes, one column for each concentration.

rack row A, 100x: ethanol, 1 uM, 3 uM, 10 uM, 30 uM, 90 uM
column 1 of the plate: ethanol only
"""

metadata = {"protocolName": "Colchicine, hepatocytes", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 7)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 8, "hepatocytes")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 9)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    p20.pick_up_tip()
    for tube, column in zip(rack.rows()[0], plate.columns()):
        for well in column[2:5]:
            p20.transfer(2, tube, well, new_tip="never")
    p20.drop_tip()
