# expect: cell_treatment pass
"""Paclitaxel, T47D.

     c1   c2   c3   c4
A    un   veh  pac  pac
B    un   veh  pac  pac
C    un   veh  pac  pac

un = untreated, veh = vehicle control, pac = paclitaxel
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("corning_24_wellplate_3.4ml_flat", 1, "T47D cells")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    dmso, paclitaxel = rack["A1"], rack["A2"]

    for row in "ABC":
        p20.transfer(10, dmso, plate[f"{row}2"])
        for column in (3, 4):
            p20.transfer(10, paclitaxel, plate[f"{row}{column}"])
