# expect: cell_treatment pass
"""One map of bortezomib for three plates of myeloma cells, none of them labelled."""

metadata = {"apiLevel": "2.16", "protocolName": "bortezomib RPMI-8226"}

MAP = """
A1,bortezomib 5 nM
A2,bortezomib 5 nM
B1,bortezomib 25 nM
B2,bortezomib 25 nM
C1,vehicle
C2,vehicle
D1,untreated
D2,untreated
"""
TUBES = {"vehicle": "D1", "bortezomib 5 nM": "D2", "bortezomib 25 nM": "D3"}


def run(ctx):
    rows = [line.split(",") for line in MAP.split("\n") if line]
    dishes = [ctx.load_labware("corning_24_wellplate_3.4ml_flat", slot) for slot in (4, 5, 6)]
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 2)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    def give(dish, well, content):
        p300.transfer(50, rack[TUBES[content]], dish[well], new_tip="always")

    for n in range(3):
        for well, content in rows:
            if content == "vehicle":
                give(dishes[n], well, content)
    for dish in dishes:
        for well, content in rows:
            if content.startswith("bortezomib"):
                give(dish, well, content)
