# expect: cell_treatment pass CELL-1!
"""Forskolin on PC12, one column per condition."""

metadata = {"protocolName": "Forskolin, PC12", "apiLevel": "2.13"}
# reservoir: A1 medium, A2 vehicle (DMSO 0.1 %), A3 to A6 forskolin 0.1, 1, 10 and 100 uM
TREATMENT = {"1": "A1", "2": "A1", "3": "A2", "4": "A3", "5": "A4", "6": "A5", "7": "A6"}


def run(protocol):
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "PC12")
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    untreated, vehicle_control, treated = cells.columns()[:2], cells.columns()[2], cells.columns()[3:7]

    for number, column in enumerate([*untreated, vehicle_control, *treated], start=1):
        m20.transfer(10, reservoir[TREATMENT[str(number)]], column[0], new_tip="always")
