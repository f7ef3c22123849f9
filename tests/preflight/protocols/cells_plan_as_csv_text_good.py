# expect: cell_treatment pass
"""Organoids: what the planning sheet exported, one line for each transfer."""

metadata = {"apiLevel": "2.13"}

PLAN = """tube,well,content,ul
A1,C3,vehicle,20
A1,D3,vehicle,20
A1,E3,vehicle,20
B1,C4,nocodazole,20
B1,D4,nocodazole,20
B1,E4,nocodazole,20
B2,C5,taxol,20
B2,D5,taxol,20
B2,E5,taxol,20
"""


def run(ctx):
    racks = [ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)]
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3, "gut organoid cells")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=racks)
    for line in PLAN.splitlines()[1:]:
        tube, well, _, volume = line.split(",")
        pip.transfer(float(volume), tubes[tube], plate[well], new_tip="always")
