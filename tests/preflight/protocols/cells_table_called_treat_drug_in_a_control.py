# expect: cell_treatment fail CELL-1
"""Myotubes with and without IGF-1, tubes and wells by dose; the tubes are not labelled."""

metadata = {"apiLevel": "2.13"}

TREAT = {  # ng/ml
    5: ("A1", ["A2", "B1"]),
    25: ("A2", ["A3", "B3"]),
    125: ("A3", ["A4", "B4"]),
}
CONTROL_WELLS = ["A1", "B1"]


def run(ctx):
    plate = ctx.load_labware("corning_24_wellplate_3.4ml_flat", 1, "myotubes")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[tips])

    def give(tube, wells):
        for well in wells:
            p300.transfer(50, rack[tube], plate[well], new_tip="always")

    give("D6", CONTROL_WELLS)
    for dose in TREAT:
        give(*TREAT[dose])
