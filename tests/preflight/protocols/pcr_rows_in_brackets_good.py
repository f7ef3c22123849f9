# expect: pcr pass PCR-4!
"""Sexing of sturgeon. Column 1: samples (A-F), G = positive control, H = NTC"""

metadata = {"protocolName": "Sex marker PCR", "apiLevel": "2.13"}


def run(ctx):
    fins = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "fin clip DNA")
    tubes = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, positive, spare = tubes["A1"], tubes["A2"], tubes["A3"]
    wells = plate.columns()[0]

    p20.transfer(10, master_mix, wells, new_tip="always")
    p20.transfer(2, fins.columns()[0][:6], wells[:6], new_tip="always")
    p20.transfer(2, positive, wells[6])
    p20.transfer(2, spare, wells[7])
