# expect: pcr fail PCR-4
"""Barcodes of bats."""

metadata = {"protocolName": "COI PCR", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 1)
    bats = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "bat DNA")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, "PCR plate")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, water = rack["A1"], rack["A2"]
    samples, ncs = plate.columns()[0], plate.columns()[1][:2]

    p20.transfer(15, master_mix, samples + ncs, new_tip="always")
    p20.transfer(5, bats.columns()[0], samples, new_tip="always")
    p20.transfer(5, water, ncs[:1])
    p20.transfer(5, bats["H1"], ncs[1])
