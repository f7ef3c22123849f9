"""Plate: columns 1 and 2 hold samples (A1-H1 in, A2-H2 out), Spalte 3 NTC."""

metadata = {"apiLevel": "2.15", "protocolName": "mecA PCR, sixteen swabs"}


def run(protocol):
    dna = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, "DNA templates")
    reactions = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "reactions")
    strips = protocol.load_labware("opentrons_96_aluminumblock_generic_pcr_strip_200ul", 3)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 4)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    master_mix, water = strips["A1"], strips["A12"]
    m20.pick_up_tip()
    for column in reactions.columns()[:3]:
        m20.aspirate(18, master_mix)
        m20.dispense(18, column[0])
    m20.drop_tip()
    for source, column in zip([dna["A1"], dna["A2"], dna["A1"]], reactions.columns()):
        m20.transfer(2, source, column[0])
