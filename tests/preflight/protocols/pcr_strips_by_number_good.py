# expect: pcr pass PCR-5!
"""Stool panel.

Strips: strip 1: water, strip 2: master mix
qPCR plate: column 3 NTC
"""

metadata = {"protocolName": "Stool qPCR", "apiLevel": "2.13"}


def run(ctx):
    strips = ctx.load_labware("opentrons_96_aluminumblock_generic_pcr_strip_200ul", 1)
    stool = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "stool DNA")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, "qPCR plate")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    first, second = strips["A1"], strips["A2"]
    goal = plate.rows()[0]

    m20.transfer(15, second, goal[:3], new_tip="always")
    for n in (0, 1):
        m20.transfer(5, stool.rows()[0][n], goal[n])
    m20.transfer(5, first, goal[2])
