# expect: cell_treatment fail CELL-1
"""Oxaliplatin on SW480 cells, 72 h."""

metadata = {"apiLevel": "2.13"}

# V = vehicle control (water), O = oxaliplatin, M = medium only
PLATE_MAP = """
row  2  3  4  5  6  7
B    V  V  O  O  O  M
C    V  V  O  O  O  M
D    V  V  O  O  O  M
"""


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "6")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "SW480")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "tubes")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    water, oxaliplatin = rack["A1"], rack["B1"]
    for row in "BCD":
        for column in (2, 3):
            p300.transfer(20, water, plate[f"{row}{column}"], new_tip="always")
        for column in (3, 4, 5, 6):
            p300.transfer(20, oxaliplatin, plate[f"{row}{column}"], new_tip="always")
