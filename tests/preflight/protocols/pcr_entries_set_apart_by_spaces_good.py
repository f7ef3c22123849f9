# expect: pcr pass
"""Worm lysates, actin PCR.

rack     D1 mix       D6 water
plate    row C   C1-C3 worm, C4-C6 NTC
templates in the rack A1-A3
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    rack = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    for well in plate.rows()[2][:6]:
        p20.transfer(15, rack["D1"], well, new_tip="always")
    for n in range(3):
        p20.transfer(5, rack.rows()[0][n], plate.rows()[2][n], new_tip="always")
        p20.transfer(5, rack["D6"], plate.rows()[2][n + 3], new_tip="always")
