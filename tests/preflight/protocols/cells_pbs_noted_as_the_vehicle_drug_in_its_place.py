# expect: cell_treatment fail CELL-2 CELL-1
metadata = {"apiLevel": "2.13", "protocolName": "LPS on RAW 264.7"}

VEHICLE_CONTROLS = ["A1", "B1", "C1"]
LPS_WELLS = ["A2", "B2", "C2", "A3", "B3", "C3"]


def run(protocol):
    cells = protocol.load_labware("corning_24_wellplate_3.4ml_flat", 1, "RAW 264.7")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    lps = tubes["A1"]
    pbs = tubes["D1"]  # vehicle

    for name in VEHICLE_CONTROLS[:2]:
        p20.transfer(10, pbs, cells[name], new_tip="always")
    for name in ["C1", *LPS_WELLS[1:]]:
        p20.transfer(10, lps, cells[name], new_tip="always")
