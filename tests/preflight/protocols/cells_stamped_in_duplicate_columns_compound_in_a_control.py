# expect: cell_treatment warn CELL-1
"""Duplicates side by side: column n of the compounds goes into columns 2n-1 and 2n of the cells.

Compounds: columns 1 to 5 kinase inhibitors, column 6 vehicle.
"""

metadata = {"apiLevel": "2.14"}


def run(ctx):
    compounds = ctx.load_labware("nest_96_wellplate_200ul_flat", 1, "compounds")
    a549 = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "A549 cells")
    box = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[box])

    for n in range(6):
        pair = [a549.columns()[2 * n][0], a549.columns()[2 * n + 1][0]]
        m20.transfer(5, compounds.columns()[n][0], pair, new_tip="once")
    # compound of A5 was low: once more
    m20.transfer(5, compounds["A5"], a549["A12"])
