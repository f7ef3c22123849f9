# expect: generic pass GEN-2!
"""Orchid ITS amplicons to 5 ng/uL."""

metadata = {"protocolName": "Normalisation of amplicons", "apiLevel": "2.13"}

VOLUMES = [(4.0, 16.0), (6.5, 13.5), (9.0, 11.0), (5.2, 14.8)]


def run(ctx):
    dna = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "amplicon DNA")
    even = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "5 ng/uL")
    water = ctx.load_labware("nest_12_reservoir_15ml", 3, "water")["A1"]
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    for (ul, _), amplicon, well in zip(VOLUMES, dna.wells(), even.wells()):
        p20.transfer(ul, amplicon, well)
    for (_, ul), well in zip(VOLUMES, even.wells()):
        p20.transfer(ul, water, well, mix_after=(2, 10), new_tip="always")
    ctx.comment("the barcode PCR takes 2 uL")
