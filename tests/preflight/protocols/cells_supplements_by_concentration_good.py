# expect: cell_treatment pass
"""T cells: stimulation, then inhibitor."""
metadata = {"apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2, "tubes")
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 5, "T cells")
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    inhibitor = rack["A1"]
    edta_5_mm = rack["B1"]
    cacl2_1_m = rack["B2"]
    vehicle = rack["C1"]
    vehicle_wells = cells.columns()[0]
    treated_wells = cells.columns()[1]
    p20.pick_up_tip()
    for w in vehicle_wells + treated_wells:
        p20.transfer(5, edta_5_mm, w.top(), new_tip="never")
    p20.drop_tip()
    p20.pick_up_tip()
    for w in vehicle_wells + treated_wells:
        p20.transfer(5, cacl2_1_m, w.top(), new_tip="never")
    p20.drop_tip()
    p20.transfer(2, vehicle, vehicle_wells, new_tip="always")
    p20.transfer(2, inhibitor, treated_wells, new_tip="always")
