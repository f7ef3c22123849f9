# expect: cell_treatment pass
"""Checkerboard of two inhibitors on A375 cells, 3 x 4."""

metadata = {"apiLevel": "2.14"}

DABRAFENIB_NM = {  # 0 = vehicle
    "A1": 0, "A2": 3, "A3": 10, "A4": 30,
    "B1": 0, "B2": 3, "B3": 10, "B4": 30,
    "C1": 0, "C2": 3, "C3": 10, "C4": 30,
}  # fmt: skip
TRAMETINIB_NM = {  # 0 = vehicle
    "A1": 0, "A2": 0, "A3": 0, "A4": 0,
    "B1": 1, "B2": 1, "B3": 1, "B4": 1,
    "C1": 5, "C2": 5, "C3": 5, "C4": 5,
}  # fmt: skip


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "6")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "A375 cells")
    first = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "dabrafenib")
    second = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "3", "trametinib")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    tubes = {0: "A1", 3: "A2", 10: "A3", 30: "A4", 1: "A2", 5: "A3"}
    for name, dose in DABRAFENIB_NM.items():
        p300.transfer(20, first[tubes[dose]], plate[name], new_tip="always")
    for name, dose in TRAMETINIB_NM.items():
        p300.transfer(20, second[tubes[dose]], plate[name], new_tip="always")
