# expect: pcr warn PCR-4
"""Fern trnH PCR.

Block: A1 mix, A2 gDNA, A3 water
"""
metadata = {"apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    block = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 3, "block")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 4, "PCR plate")
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    ntc = plate["H1"]
    # mix
    p20.transfer(15, block["A1"], [*plate.columns()[0][:6], ntc], new_tip="always")
    # gDNA
    p20.transfer(5, block["A2"], plate.columns()[0][:6], new_tip="always")
    # water
    p20.transfer(5, block["A2"], ntc)
