"""Norovirus RT-qPCR.

PCR plate (row - content)
A   oyster 1
B   oyster 2
C   oyster 3
D   NTC
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (1, 2)]
    strips = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3, "RNA")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 4, "PCR plate")
    tubes = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    for row in plate.rows()[:4]:
        for well in row[:3]:
            p20.transfer(15, tubes["A1"], well, new_tip="always")  # mix; A2 is water
    for source, row in zip([strips["A1"], strips["B1"], strips["C1"], strips["C1"]], plate.rows()):
        for well in row[:3]:
            p20.transfer(5, source, well, new_tip="always")
