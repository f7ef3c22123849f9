# expect: pcr warn PCR-4 PCR-6
from opentrons import protocol_api

metadata = {"apiLevel": "2.13", "protocolName": "Phytoplasma, four trees"}


def run(protocol: protocol_api.ProtocolContext):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", "9")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "4")
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])

    protocol.comment("Tube B1 is the master mix, 16 ul to A1-A6 of the plate.")
    p20.pick_up_tip()
    for n in range(1, 7):
        p20.aspirate(16, rack["B1"])
        p20.dispense(16, plate[f"A{n}"])
    p20.drop_tip()

    protocol.comment("A6 is the no-template control: 4 ul water from tube B2.")
    p20.transfer(4, rack["B2"], plate["A6"])
    protocol.comment("A1-A4: DNA of the four trees, tubes C1-C4.")
    for n in (1, 2, 3, 6):
        p20.transfer(4, rack[f"C{min(n, 4)}"], plate[f"A{n}"])
    protocol.comment("A5 is the positive control: 4 ul of the insert plasmid, tube D1.")
    p20.transfer(4, rack["D1"], plate["A5"])
