# expect: cell_treatment pass
"""Dose response on OVCAR-3 (8-channel).

Column 1     vehicle control
Columns 2-7  olaparib, low to high
Column 12    untreated
"""

metadata = {"protocolName": "OVCAR-3, olaparib", "apiLevel": "2.13"}

VEHICLE_COLUMN = 1
OLAPARIB_COLUMNS = [2, 3, 4, 5, 6, 7]


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "OVCAR-3 cells")
    deep = protocol.load_labware("nest_96_wellplate_2ml_deep", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 3)
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    dmso = deep["A12"]
    drugs, medium = deep.rows()[0][:6], deep["A8"]

    m300.transfer(60, medium, plate.rows()[0], new_tip="once")
    m300.transfer(20, dmso, plate.columns()[VEHICLE_COLUMN - 1], new_tip="always")
    for drug, number in zip(drugs, OLAPARIB_COLUMNS):
        m300.transfer(20, drug, plate.columns()[number - 1], new_tip="always")
