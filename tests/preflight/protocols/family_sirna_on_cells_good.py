# expect: cell_treatment pass
"""Reverse transfection: siRNA pools onto the bottom, cells come on top by hand."""

metadata = {"protocolName": "Transfection, 6 siRNA pools", "apiLevel": "2.13"}

MOCK = ["B8", "C8", "D8"]


def run(ctx):
    pools = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "siRNA pools")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "transfection plate")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    sirna = pools.columns()[0][:6]
    for at, pool in enumerate(sirna, 2):
        for row in "BCD":
            p20.transfer(10, pool, plate[f"{row}{at}"], new_tip="always")
    mock = [plate[name] for name in MOCK]
    p20.transfer(10, pools["H12"], mock, new_tip="always")
