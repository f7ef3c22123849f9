# expect: cell_treatment fail CELL-1
"""Columns 1-8 idelalisib, column 9 vehicle (saline), column 10 untreated; one dose column too many."""

metadata = {"protocolName": "Idelalisib on Ramos cells", "apiLevel": "2.13"}


def run(ctx):
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "Ramos cells")
    doses = ctx.load_labware("nest_96_wellplate_2ml_deep", 3, "idelalisib dose plate")
    saline = ctx.load_labware("nest_12_reservoir_15ml", 5)["A1"]
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    vehicle_column = cells["A9"]
    m20.transfer(10, saline, vehicle_column, new_tip="always")
    for number in range(1, 10):
        m20.transfer(10, doses[f"A{number}"], cells[f"A{number}"], new_tip="always")
