# expect: bradford pass BRD-3! BRD-4!
"""Proteinbestimmung nach Bradford."""

metadata = {"apiLevel": "2.13", "protocolName": "Bradford"}
EICHREIHE = [(0, "A1", "A1"), (100, "A2", "B1"), (250, "A3", "C1"), (500, "A4", "D1")]
PROBEN = [("Aufschluss 1", "C1", "A2"), ("Aufschluss 2", "C2", "B2")]


def run(protocol):
    platte = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    gestell = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    wanne = protocol.load_labware("nest_1_reservoir_195ml", 3, "Wanne mit Bradford-Reagenz")
    klein = protocol.load_labware("opentrons_96_tiprack_20ul", 4)
    gross = protocol.load_labware("opentrons_96_tiprack_300ul", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[klein])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[gross])
    for _, gefaess, vertiefung in EICHREIHE + PROBEN:
        p20.transfer(10, gestell[gefaess], platte[vertiefung])
    for _, _, vertiefung in EICHREIHE + PROBEN:
        p300.transfer(200, wanne["A1"], platte[vertiefung], mix_after=(3, 100))
