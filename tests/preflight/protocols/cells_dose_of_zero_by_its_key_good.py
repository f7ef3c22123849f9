# expect: cell_treatment pass CELL-1!
"""Nutlin on RPE1 cells, four wells for each dose."""

metadata = {"protocolName": "Nutlin, RPE1 cells", "apiLevel": "2.13"}

DOSES_UM = {0: "A1", 1: "A2", 10: "A3"}  # tubes; 0 is DMSO in medium


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "RPE1 cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    vehicle_controls = plate.columns()[0][:4]

    p20.transfer(10, rack[DOSES_UM[0]], vehicle_controls, new_tip="always")
    p20.transfer(10, rack[DOSES_UM[1]], plate.columns()[1][:4], new_tip="always")
    p20.transfer(10, rack[DOSES_UM[10]], plate.columns()[2][:4], new_tip="always")
