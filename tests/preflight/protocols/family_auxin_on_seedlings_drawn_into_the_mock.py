# expect: cell_treatment fail CELL-1
"""Arabidopsis seedlings in 96 wells, IAA in three strengths. Row layout below."""

metadata = {"protocolName": "Auxin response", "apiLevel": "2.9", "author": "plant lab"}

ROWS = {"A": "mock", "B": "IAA 10 nM", "C": "IAA 100 nM", "D": "IAA 1 uM"}


def run(ctx):
    seedlings = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "seedlings")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "auxin")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    iaa = {"IAA 10 nM": rack["A1"], "IAA 100 nM": rack["A2"], "IAA 1 uM": rack["A3"]}

    mock = seedlings.rows_by_name()["A"]
    p20.transfer(5, rack["D1"], mock, new_tip="once")
    for row, strength in ROWS.items():
        if strength == "mock":
            strength = "IAA 10 nM"
        p20.pick_up_tip()
        for well in seedlings.rows_by_name()[row]:
            p20.transfer(5, iaa[strength], well, new_tip="never")
        p20.drop_tip()
