# expect: cell_treatment pass CELL-1! CELL-2!
"""Gefitinib on A431 cells.

Cell plate, column 1: A = vehicle, B..H = gefitinib; column 2: A..G = gefitinib, H = vehicle.
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "7")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "cell plate")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "tubes")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    vehicle, gefitinib = rack["A1"], rack["A2"]
    for column in (plate.columns()[0], plate.columns()[1][::-1]):
        p300.transfer(20, vehicle, column[0])
        for well in column[1:]:
            p300.transfer(20, gefitinib, well, new_tip="always")
