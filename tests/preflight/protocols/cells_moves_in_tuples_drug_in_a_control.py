# expect: cell_treatment fail CELL-1 CELL-2?
metadata = {"protocolName": "Glioma spheroids, temozolomide", "apiLevel": "2.13"}

MOVES = [
    ("C1", "B2", "solvent"),
    ("C1", "B3", "solvent"),
    ("A1", "B4", "solvent"),
    ("A1", "C2", "temozolomide"),
    ("A1", "C3", "temozolomide"),
    ("A1", "C4", "temozolomide"),
]


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 7)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 5, "glioma cells")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    for move in MOVES:
        pip.transfer(25, tubes[move[0]], plate[move[1]], new_tip="always")
