# expect: pcr pass PCR-5!
"""Metabarcoding, one tagged mix a site."""

metadata = {"protocolName": "18S PCR", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 1)
    soil = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "soil DNA")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, "PCR plate")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    water = rack["D6"]
    mixes = {}
    mixes["pos. lagoon"] = rack["A1"]
    mixes["neg. desert"] = rack["A2"]

    for mix, column in zip(mixes.values(), plate.columns()):
        *wells, ntc = column[:6]
        p20.transfer(15, mix, column[:6], new_tip="always")
        p20.transfer(5, soil.columns()[0][:5], wells, new_tip="always")
        p20.transfer(5, water, ntc)
