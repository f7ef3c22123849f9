# expect: bradford pass
from opentrons import protocol_api

metadata = {"protocolName": "Coomassie assay, source plate in duplicate", "apiLevel": "2.14"}

CONTENT = {
    "A1": ("blank", 0), "B1": ("BSA", 100), "C1": ("BSA", 300), "D1": ("BSA", 900),
    "A2": ("unknown", "batch 7"), "B2": ("unknown", "batch 8"),
    "C2": ("unknown", "batch 9"), "D2": ("unknown", "batch 10"),
}
INTO = {"1": ("1", "2"), "2": ("3", "4")}


def run(protocol: protocol_api.ProtocolContext):
    small = protocol.load_labware("opentrons_96_filtertiprack_20ul", "1")
    large = protocol.load_labware("opentrons_96_tiprack_300ul", "4")
    p20 = protocol.load_instrument("p20_single_gen2", "left", [small])
    p300 = protocol.load_instrument("p300_single_gen2", "right", [large])
    prepared = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", "2", "prepared")
    reading = protocol.load_labware("corning_96_wellplate_360ul_flat", "3", "reading plate")
    dye = protocol.load_labware("nest_12_reservoir_15ml", "5", "dye")["A1"]

    def pair(name):
        return [reading[name[0] + column] for column in INTO[name[1]]]

    curve = [name for name, (kind, _) in CONTENT.items() if kind != "unknown"]
    unknowns = [name for name in CONTENT if name not in curve]
    for turn in (0, 1):
        p20.pick_up_tip()
        for name in curve:
            p20.aspirate(5, prepared[name])
            p20.dispense(5, pair(name)[turn])
        p20.drop_tip()
    for name in unknowns:
        p20.transfer(5, prepared[name], pair(name), new_tip="always")
    for name in CONTENT:
        for well in pair(name):
            p300.transfer(200, dye, well, mix_after=(3, 120), new_tip="always")
