# expect: pcr pass PCR-1! PCR-2! PCR-4!
"""Shark eDNA, PCR

TUBES (C3): A1 master mix, B1 water
TUBES (C2): A1-A6 shark DNA
plate in D1: G1 NTC
"""

requirements = {"robotType": "Flex", "apiLevel": "2.16"}


def run(ctx):
    n = ctx.load_labware("biorad_96_wellplate_200ul_pcr", "D1")
    m = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "C2")
    e = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "C3")
    tips = ctx.load_labware("opentrons_flex_96_filtertiprack_50ul", "B1")
    ctx.load_trash_bin("A3")
    one = ctx.load_instrument("flex_1channel_50", "left", tip_racks=[tips])
    one.transfer(15, e["A1"], n.wells()[:7])
    one.transfer(5, e["B1"], n["G1"])
    for k in range(6):
        one.transfer(5, m.rows()[0][k], n.wells()[k])
