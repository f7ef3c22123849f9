# expect: pcr pass
"""Genotyping of mouse pups. The plate comes from the DNA station with its eluates in it."""
from opentrons import protocol_api

metadata = {"protocolName": "Pups, PCR mix onto DNA", "apiLevel": "2.15"}


def run(protocol: protocol_api.ProtocolContext):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "PCR plate")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)

    tail_dna = protocol.define_liquid("tail DNA", "eluate of one pup per well", "#bb4411")
    blank = protocol.define_liquid("elution buffer", "no template", "#99bbee")
    pups = plate.columns()[0][:6]
    ntc = plate["H1"]
    for well in pups:
        well.load_liquid(tail_dna, 3)
    ntc.load_liquid(blank, 3)

    master_mix = rack["A1"]

    # the NTC first, then every pup with a tip of its own
    for well in [ntc, *pups]:
        p20.pick_up_tip()
        p20.aspirate(17, master_mix)
        p20.dispense(17, well)
        p20.mix(3, 12, well)
        p20.drop_tip()
