"""Tick pathogens. PCR plate: ticks in columns 1-6. NTCs H3 + H6"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (1, 2)]
    dna = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3, "tick DNA")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 4, "PCR plate")
    tubes = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    master_mix, water = tubes["A1"], tubes["A2"]
    for well in plate.wells()[:48]:
        p20.transfer(18, master_mix, well, new_tip="always")
    for well in plate.wells()[:48]:
        source = water if well.well_name in ("H3", "G6") else dna[well.well_name]
        p20.transfer(2, source, well, new_tip="always")
