# expect: cell_treatment warn CELL-2
"""Docking hits on Vero cells, hits in columns 1-3.

Last three columns: 10 = vehicle, 11 = remdesivir, 12 = untreated
"""

metadata = {"protocolName": "Antiviral screen", "apiLevel": "2.13"}


def run(ctx):
    hits = ctx.load_labware("nest_96_wellplate_200ul_flat", 1, "hit compounds")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    vero = ctx.load_labware("corning_96_wellplate_360ul_flat", 3, "Vero cells")
    boxes = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=boxes)
    dmso, remdesivir = tubes["A1"], tubes["B1"]

    for column in range(3):
        p20.transfer(3, hits.columns()[column], vero.columns()[column], new_tip="always")
    p20.transfer(3, dmso, vero.columns()[9][:7], new_tip="always")
    p20.transfer(3, remdesivir, vero.columns()[10], new_tip="always")
