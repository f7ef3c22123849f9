# expect: cell_treatment fail CELL-1
"""Rapamycin on jurkats."""

metadata = {"protocolName": "Rapamycin, Jurkat", "apiLevel": "2.13"}
DOSE_NM = {"B2": 0, "B3": 1, "B4": 10, "B5": 100, "C2": 0, "C3": 1, "C4": 10, "C5": 100}


def run(protocol):
    plate = protocol.load_labware("corning_24_wellplate_3.4ml_flat", 1, "Jurkat cells")
    drugs = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    for number, well in enumerate(DOSE_NM):
        # drug for 24 h
        p20.transfer(5, drugs.wells()[number % 4], plate[well])
    # once more where the cells had detached
    for well in ("C2", "C4"):
        p20.transfer(5, drugs["C1"], plate[well])
