# expect: pcr pass PCR-1! PCR-2! PCR-4!
"""Genotyping, a plate of DNA onto a plate of reactions, same wells.

DNA plate: columns 1-11 DNA, A12-F12 DNA, G12 = DNA of the breed standard (positive control),
H12 = nuclease-free water, the NTC.
"""
metadata = {"protocolName": "Genotyping stamp", "apiLevel": "2.14"}


def run(protocol):
    dna = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, "DNA plate")
    taqman = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "TaqMan")
    strip = protocol.load_labware("nest_12_reservoir_15ml", 3)
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (4, 5)]
    m20 = protocol.load_instrument("p20_multi_gen2", "right", tip_racks=tips)
    master_mix = strip["A1"]
    m20.pick_up_tip()
    for column in taqman.columns():
        m20.aspirate(16, master_mix)
        m20.dispense(16, column[0])
    m20.drop_tip()
    for source, target in zip(dna.columns(), taqman.columns()):
        m20.pick_up_tip()
        m20.aspirate(4, source[0])
        m20.dispense(4, target[0])
        m20.mix(3, 10, target[0])
        m20.drop_tip()
