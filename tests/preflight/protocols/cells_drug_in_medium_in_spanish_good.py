# expect: cell_treatment pass CELL-1!
metadata = {"protocolName": "Celulas PC9, 48 h", "apiLevel": "2.13"}

TUBOS = {"A1": "DMSO 11x en RPMI", "A2": "GEF 11x en RPMI", "A3": "OSI 11x en RPMI"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    placa = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "celulas")
    puntas = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[puntas])
    cero, uno, dos = [rack[tubo] for tubo in TUBOS]
    controles = placa.columns()[0][:5]

    p20.transfer(10, cero, controles, new_tip="always")
    p20.transfer(10, uno, placa.columns()[1][:5], new_tip="always")
    p20.transfer(10, dos, placa.columns()[2][:5], new_tip="always")
