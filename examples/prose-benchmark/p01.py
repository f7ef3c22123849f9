"""Tucatinib on BT-474. V = vehicle (0.1 % DMSO), L = low dose, H = high dose."""

metadata = {"apiLevel": "2.14"}
DRUGS = {"V": "C1", "L": "C2", "H": "C3"}
WELLS = {"V": ["B2", "C2"], "L": ["B3", "C3"], "H": ["B4", "C4"]}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "9")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", "BT-474")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "5", "tubes")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    for code, tube in DRUGS.items():
        for well in WELLS["H" if code == "V" else "V" if code == "H" else code]:
            p300.transfer(25, rack[tube], plate[well], new_tip="always")
