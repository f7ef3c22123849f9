# expect: pcr pass
from opentrons import protocol_api

metadata = {"protocolName": "eDNA qPCR, pond survey", "apiLevel": "2.13"}

RUNS = [
    {"id": "pond_1", "tube": "A1", "wells": ["A1", "A2"]},
    {"id": "pond_2", "tube": "A2", "wells": ["B1", "B2"]},
    {"id": "pond_3", "tube": "A3", "wells": ["C1", "C2"]},
    {"id": "field_ntc", "tube": "A5", "wells": ["E1", "E2"]},
]
MIX_UL, DNA_UL = 16, 4


def run(protocol: protocol_api.ProtocolContext):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "1", "extracts")
    block = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", "2")
    qpcr = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "3", "qPCR plate")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", "4")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix = block["A1"]

    def load(tube, wells):
        for name in wells:
            p20.transfer(DNA_UL, rack[tube], qpcr[name], new_tip="always")

    for row in RUNS:
        for name in row["wells"]:
            p20.transfer(MIX_UL, master_mix, qpcr[name], new_tip="always")
    for row in RUNS:
        tube, wells = row["tube"], row["wells"]
        load(tube, wells)
