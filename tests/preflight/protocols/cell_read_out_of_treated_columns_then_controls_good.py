# expect: cell_treatment pass CELL-1!
"""Caco-2, four doses of a flavonoid, read with resazurin."""

metadata = {"apiLevel": "2.15"}

DOSES = {3: "80 uM", 4: "40 uM", 5: "20 uM", 6: "10 uM"}


def run(ctx):
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "Caco-2 cell plate")
    doses = ctx.load_labware("nest_96_wellplate_2ml_deep", 1, "Quercetin doses, columns 3-6")
    trough = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tips = [ctx.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (8, 9)]
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    vehicle, resazurin = trough["A1"], trough["A3"]
    untreated, vehicle_control = cells["A1"], cells["A2"]

    for column in DOSES:
        m300.transfer(50, doses[f"A{column}"], cells[f"A{column}"], new_tip="always")
    m300.transfer(50, vehicle, vehicle_control, new_tip="always")
    ctx.comment(f"{untreated} gets nothing")

    # resazurin: treated columns first, then controls, a tip for each
    for column in (6, 5, 4, 3, 2, 1):
        m300.transfer(20, resazurin, cells[f"A{column}"], new_tip="always")
