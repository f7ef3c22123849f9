# expect: cell_treatment pass
"""Synergy screen, RKO."""

metadata = {"protocolName": "RKO synergy", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "RKO cells")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    p20 = ctx.load_instrument(
        "p20_single_gen2", "left", [ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)]
    )
    # vehicle controls on top
    rows = plate.rows()

    vehicle, drug = tubes["A1"], tubes["B1"]
    for well in rows[1][2:8]:
        p20.transfer(7, vehicle, well, new_tip="always")
    for well in rows[2][2:8] + rows[3][2:8]:
        p20.transfer(7, drug, well, new_tip="always")
