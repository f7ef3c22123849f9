# expect: generic fail GEN-1 GEN-2
"""Amplicons to equal volumes of one concentration."""

metadata = {"protocolName": "Normalisation of amplicons", "apiLevel": "2.13"}

VOLUMES = [(4.0, 16.0), (6.5, 13.5), (9.0, 11.0), (5.2, 14.8)]


def run(ctx):
    amplicons = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "amplicons")
    normalised = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "normalised")
    te = ctx.load_labware("nest_12_reservoir_15ml", 3, "TE")["A1"]
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    for (dna, _), source, well in zip(VOLUMES, amplicons.wells(), normalised.wells()):
        p20.transfer(dna, source, well)
    p20.pick_up_tip()
    for (_, buffer), well in zip(VOLUMES, normalised.wells()):
        p20.transfer(buffer, te, well, mix_after=(2, 10), new_tip="never")
    p20.drop_tip()
    ctx.comment("the barcode PCR takes 2 uL")
