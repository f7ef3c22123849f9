# expect: cell_treatment pass CELL-1!
"""Forskolin on PC12, one column per condition."""

metadata = {"protocolName": "Forskolin, PC12", "apiLevel": "2.13"}
# trough: A1 medium, A2 vehicle (DMSO 0.1 %), A3 to A6 forskolin 0.1, 1, 10 and 100 uM
# plate: columns 1 and 2 untreated, column 3 vehicle control, columns 4 to 7 forskolin, rising
TREATMENT = {"1": "A1", "2": "A1", "3": "A2", "4": "A3", "5": "A4", "6": "A5", "7": "A6"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "PC12")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])

    for column, lane in TREATMENT.items():
        m20.transfer(10, trough[lane], plate.columns_by_name()[column][0], new_tip="always")
