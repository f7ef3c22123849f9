# Carrier screen.
#   slot 1   patient DNA, tubes A1 to A3
#   slot 2   reagents: tube A1 the master mix, tube A3 the PCR water
#   slot 3   the PCR plate: A1 B1 C1 patients 1-3, D1 NTC

metadata = {"apiLevel": "2.13", "protocolName": "Carrier screen PCR"}


def run(protocol):
    rack = "opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap"
    dna = protocol.load_labware(rack, 1, "patient DNA")
    reagents = protocol.load_labware(rack, 2, "PCR reagents")
    pcr = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3, "PCR plate")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 6)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    p20.transfer(16, reagents["A1"], [pcr[name] for name in ("A1", "B1", "C1")])
    p20.transfer(4, reagents["A3"], pcr["D1"], mix_after=(3, 10))
    for name, tube in (("A1", "A1"), ("B1", "A2"), ("C1", "A3")):
        p20.transfer(4, dna[tube], pcr[name], mix_after=(3, 10))
