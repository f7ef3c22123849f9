# expect: cell_treatment pass
"""
Olaparib on MCF-7, 24 wells.

MCF-7 grow in slot 4 since Monday.

    A    untreated
    B    vehicle control (DMSO)
    C    olaparib 2 uM
    D    olaparib 8 uM

Tubes (slot 5): A1 DMSO, B1 olaparib for 2 uM, C1 olaparib for 8 uM.
Rows B-D are given 15 uL from their tube, a new tip for every well.
"""
metadata = {"apiLevel": "2.14", "protocolName": "MCF-7 olaparib"}


def run(ctx):
    cells = ctx.load_labware("corning_24_wellplate_3.4ml_flat", 4, "MCF-7")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[ctx.load_labware("opentrons_96_filtertiprack_20ul", 7)])

    for letter, tube in (("B", "A1"), ("C", "B1"), ("D", "C1")):
        for well in cells.rows_by_name()[letter]:
            p20.transfer(15, tubes[tube], well, new_tip="always")
