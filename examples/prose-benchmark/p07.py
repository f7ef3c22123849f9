"""Niclosamide on MDCK cells, quadruplicates, two rows each."""

metadata = {"protocolName": "Niclosamide MDCK", "apiLevel": "2.13"}

SEQUENCE = ["DMSO", "0.3 uM", "1 uM", "3 uM", "9 uM"]


def run(ctx):
    strip = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 5, "MDCK cells")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 6)
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[tips])

    for i, what in enumerate(SEQUENCE):
        ctx.comment(f"column {i + 1}: {what}")
        p20.transfer(4, strip.rows()[0][i], plate.columns()[i][:4], new_tip="always")
