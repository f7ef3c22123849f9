# expect: cell_treatment warn CELL-1
"""Cisplatin beside its solvent. odd columns -> DMSO, even columns -> cisplatin"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    trough = ctx.load_labware("nest_12_reservoir_15ml", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "A2780 cells")
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    solvent, cisplatin = trough["A1"], trough["A2"]

    for number in range(0, 6, 2):
        m300.transfer(20, solvent, plate.columns()[number][0])
    for number in (1, 3, 4, 5):
        m300.transfer(20, cisplatin, plate.columns()[number][0])
