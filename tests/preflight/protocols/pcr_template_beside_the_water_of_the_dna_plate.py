# expect: pcr fail PCR-4
metadata = {"apiLevel": "2.15", "protocolName": "COI barcoding PCR"}


def run(protocol):
    dna = protocol.load_labware(
        "biorad_96_wellplate_200ul_pcr", 1, "insect DNA, columns 1-2 (H1 = water)"
    )
    strips = protocol.load_labware("opentrons_96_aluminumblock_generic_pcr_strip_200ul", 3)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 4)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    # the master mix stands in strip columns 1 and 2
    mixes = [strips["A1"], strips["A2"]]
    ntc = plate["H2"]  # water in the place of DNA

    m20.pick_up_tip()
    for mix, column in zip(mixes, plate.columns()):
        m20.aspirate(18, mix)
        m20.dispense(18, column[0])
    m20.drop_tip()
    for source, column in zip(dna.columns()[:2], plate.columns()[:2]):
        m20.transfer(2, source[0], column[0])
