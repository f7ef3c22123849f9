"""Brings gDNA eluates to 20 ng/uL in 60 uL before library prep."""

from opentrons import protocol_api

metadata = {"protocolName": "gDNA normalisation", "apiLevel": "2.15", "author": "Sequencing"}

# well, ng/uL from the Qubit
QUBIT = """
A1 84.2
B1 61.0
C1 120.7
D1 45.5
E1 39.9
F1 97.3
G1 150.0
H1 72.4
A2 55.1
B2 66.6
C2 108.3
D2 41.2
"""
TARGET, FINAL = 20.0, 60.0


def plan():
    for line in QUBIT.strip().splitlines():
        name, conc = line.split()
        dna = round(TARGET * FINAL / float(conc), 1)
        yield name, dna, round(FINAL - dna, 1)


def run(ctx: protocol_api.ProtocolContext):
    eluates = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, label="gDNA eluates")
    normalised = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, label="Normalised DNA")
    eb_rack = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 3, label="Buffer EB")
    tips20 = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    tips200 = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[tips200])

    eb = eb_rack["A1"]
    eb.load_liquid(ctx.define_liquid("EB", "10 mM Tris pH 8.5", "#88bbff"), 1500)
    gdna = ctx.define_liquid("gDNA", "eluted", "#aa5500")
    work = list(plan())
    for name, _, _ in work:
        eluates[name].load_liquid(gdna, 50)

    # buffer first, one tip, the wells are still dry
    p300.pick_up_tip()
    for name, _, buffer_ul in work:
        p300.aspirate(buffer_ul, eb)
        p300.dispense(buffer_ul, normalised[name])
    p300.drop_tip()

    for name, dna_ul, _ in work:
        pipette = p20 if dna_ul <= 20 else p300
        pipette.pick_up_tip()
        pipette.aspirate(dna_ul, eluates[name])
        pipette.dispense(dna_ul, normalised[name])
        pipette.mix(4, 20 if pipette is p20 else 40, normalised[name])
        pipette.drop_tip()
