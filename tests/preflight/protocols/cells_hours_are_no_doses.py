# expect: cell_treatment pass
"""Time course with staurosporine."""
from opentrons import protocol_api
metadata = {"apiLevel": "2.14"}
HOURS = {"B2": 0, "B3": 1, "B4": 4, "B5": 24, "C2": 0, "C3": 1, "C4": 4, "C5": 24}


def run(ctx: protocol_api.ProtocolContext):
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "A549")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    staurosporine = rack["D1"]
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    for well, hours in sorted(HOURS.items(), key=lambda i: -i[1]):
        p300.transfer(50, staurosporine, cells[well])
        ctx.delay(minutes=1)
