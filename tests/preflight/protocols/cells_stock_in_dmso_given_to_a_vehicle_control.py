# expect: cell_treatment fail CELL-1
"""Compound 3 mM in DMSO goes onto Vero cells; the vehicle has its own tube."""

metadata = {"protocolName": "Vero, antiviral", "apiLevel": "2.13"}


def run(ctx):
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    vero = ctx.load_labware("corning_96_wellplate_360ul_flat", 3, "Vero cells")
    p20 = ctx.load_instrument(
        "p20_single_gen2", "right", [ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)]
    )
    stock = tubes["A1"]  # 3 mM in DMSO
    vehicle = tubes["A6"]  # DMSO
    treated = vero.columns()[2][1:5]
    vehicle_control = vero.columns()[3][1:5]
    p20.transfer(3, stock, treated + vehicle_control[-1:], new_tip="always", mix_after=(2, 15))
    p20.transfer(3, vehicle, vehicle_control, new_tip="always", mix_after=(2, 15))
