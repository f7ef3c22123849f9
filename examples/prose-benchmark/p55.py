"""Kinase inhibitor on HCT116, one 24-well plate."""

metadata = {"protocolName": "inhibitor panel", "apiLevel": "2.13"}

# k: vehicle (0.1 % DMSO), o: untreated, a1..a3: inhibitor 1, 3 and 10 uM
MAP = """
k a1 a2 a3 o o
k a1 a2 a3 o o
k a1 a2 a3 o o
k a1 a2 a3 o o
"""


def run(protocol):
    plate = protocol.load_labware("corning_24_wellplate_3.4ml_flat", 1, "HCT116")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 7)
    pip = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    grid = [line.split() for line in MAP.strip().splitlines()]
    stocks = {"k": tubes["D1"], "a1": tubes["A1"], "a2": tubes["A2"], "a3": tubes["A3"]}
    drug, dmso = tubes.rows()[0][:3], tubes["D1"]
    for row, codes in zip(plate.rows(), grid):
        for well, code in zip(row, codes):
            if code in stocks and well.well_name != "D1":
                pip.transfer(50, stocks[code], well, new_tip="always")
