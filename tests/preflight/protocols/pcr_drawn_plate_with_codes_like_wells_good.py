# expect: pcr pass PCR-4!
"""eDNA of five ponds in duplicate.

     1     2    3
A    E1    E1   NTC
B    E2    E2   NTC
C    E3    E3
D    E4    E4
E    E5    E5

E1-E5 = extracts
"""

metadata = {"protocolName": "eDNA qPCR", "apiLevel": "2.13"}


def run(ctx):
    tubes = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 1)
    ponds = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "pond DNA")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, water = tubes["A1"], tubes["A2"]
    one, two, three = (column[:5] for column in plate.columns()[:3])

    p20.transfer(15, master_mix, one + two + three[:2], new_tip="always")
    for column in (one, two):
        p20.transfer(5, ponds.columns()[0][:5], column, new_tip="always")
    p20.transfer(5, water, three[:2], new_tip="always")
