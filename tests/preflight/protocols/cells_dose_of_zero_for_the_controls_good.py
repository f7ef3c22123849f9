# expect: cell_treatment pass CELL-1!
"""Metformin on myoblasts; the tube without any stands in A1."""

metadata = {"protocolName": "Metformin, myoblasts", "apiLevel": "2.13"}

DOSES = {0: "A1", 1: "A2", 10: "A3"}  # mM
WELLS = {0: ["B6", "C6", "D6"], 1: ["B5", "C5", "D5"], 10: ["B4", "C4", "D4"]}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_24_wellplate_3.4ml_flat", 2, "myoblasts")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    control_wells = [plate[spot] for spot in WELLS[0]]

    for dose, spot in DOSES.items():
        wells = control_wells if dose == 0 else [plate[well] for well in WELLS[dose]]
        p20.transfer(10, rack[spot], wells, new_tip="always")
