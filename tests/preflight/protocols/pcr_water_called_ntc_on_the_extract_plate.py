# expect: pcr warn PCR-2
"""RT-qPCR set-up, eluates to reaction plate, same positions.

Eluate plate: A1-F2 patient RNA, G2 = positive control, H2 = water (NTC).
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (7, 8)]
    eluates = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "RNA eluates")
    reactions = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "reaction plate")
    mix = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 3)["A1"]
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=tips)
    p20.transfer(15, mix, reactions.wells()[:16], new_tip="once")
    for n in range(14):
        p20.transfer(5, eluates.wells()[n], reactions.wells()[n])
    p20.transfer(5, eluates.wells()[14:16], reactions.wells()[14:16], new_tip="once")
