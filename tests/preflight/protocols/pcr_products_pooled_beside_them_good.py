"""PCR of amplicons; products into one well."""

metadata = {"apiLevel": "2.15", "protocolName": "Amplicon PCR"}


def run(protocol):
    plate = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    dna = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3, "DNA")
    gel = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 7, "gel")
    racks = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=racks)
    master_mix, water = rack["D6"], rack["D5"]
    reactions, ntc = plate.wells()[:5], plate["H1"]

    p20.transfer(18, master_mix, [*reactions, ntc], new_tip="always")
    p20.transfer(2, dna.wells()[:5], reactions, new_tip="always", mix_after=(3, 10))
    p20.transfer(2, water, ntc)
    p20.transfer(5, reactions, plate["H12"], new_tip="always")
