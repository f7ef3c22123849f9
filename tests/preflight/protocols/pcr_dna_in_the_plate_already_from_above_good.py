# expect: pcr pass
"""Genotyping of mouse pups: the mix falls onto the DNA from above, with one tip."""
from opentrons import protocol_api

metadata = {"protocolName": "Pups, PCR mix onto DNA", "apiLevel": "2.15"}


def run(protocol: protocol_api.ProtocolContext):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "PCR plate")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)

    tail_dna = protocol.define_liquid("tail DNA", "eluate of one pup per well", "#bb4411")
    pups = plate.columns()[0][:6]
    ntc = plate["H1"]
    for well in pups:
        well.load_liquid(tail_dna, 3)

    master_mix = rack["A1"]
    water = rack["B1"]

    p20.transfer(3, water, ntc)
    p20.pick_up_tip()
    for well in [*pups, ntc]:
        p20.aspirate(17, master_mix)
        p20.dispense(17, well.top())
    p20.drop_tip()
