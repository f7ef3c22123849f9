# expect: pcr pass PCR-1!
"""Typing of eight barley lines at one locus."""

metadata = {"protocolName": "PCR, barley", "apiLevel": "2.13"}


def run(ctx):
    leaves = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "barley DNA")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, water = tubes["A1"], tubes["A2"]
    lines, last = plate.columns()[0], plate["A2"]

    p20.transfer(17, master_mix, [*lines, last], new_tip="always")
    p20.transfer(3, leaves.columns()[0], lines, new_tip="always")
    p20.transfer(3, water, last)
