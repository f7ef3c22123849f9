# expect: pcr fail PCR-1
"""Bat guano, 12S PCR in one rack of strips."""

metadata = {"protocolName": "Bat diet 12S PCR", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    strips = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=tips)

    red, blue = rack["D5"], rack["D6"]
    templates = rack.wells()[:11]
    water = rack["C6"]
    wells = strips.wells()[:12]
    ntc = wells[11]
    p20.transfer(17, red, wells[:5], new_tip="once")
    p20.transfer(17, blue, wells[6:], new_tip="once")
    for template, well in zip(templates, wells):
        p20.transfer(3, template, well, new_tip="always")
    p20.transfer(3, water, ntc)
