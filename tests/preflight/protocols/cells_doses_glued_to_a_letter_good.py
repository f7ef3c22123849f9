# expect: cell_treatment pass CELL-1!
"""Rapamycin on osteoclasts, two wells of each."""

metadata = {"protocolName": "Osteoclasts", "apiLevel": "2.13"}

UNTREATED = ["B2", "C2"]
VEH = ["B3", "C3"]
R10nM = ["B4", "C4"]
R30nM = ["B5", "C5"]
R90nM = ["B6", "C6"]


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_24_wellplate_3.4ml_flat", 2, "osteoclasts")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    dmso, macrolide = rack["A1"], rack["A2"]

    for spot in VEH:
        p20.transfer(18, dmso, plate[spot])
    for volume, wells in [(2, R10nM), (6, R30nM), (18, R90nM)]:
        for spot in wells:
            p20.transfer(volume, macrolide, plate[spot])
