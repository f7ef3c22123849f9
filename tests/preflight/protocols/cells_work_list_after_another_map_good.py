# expect: cell_treatment pass
metadata = {"apiLevel": "2.13"}
SPARE = {"H12": "blank"}
PICKS = [("A2", "B5", "vehicle"), ("A3", "B6", "drug")]


def run(ctx):
    deep = ctx.load_labware("nest_96_wellplate_2ml_deep", 1, "stocks")
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "HepG2 cells")
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    for source, dest, _ in PICKS:
        p20.transfer(10, deep[source], cells[dest], new_tip="always")
