# expect: cell_treatment pass
"""Cisplatin in eight columns, DMSO in one: a helper makes the well of a row and a column."""

metadata = {"apiLevel": "2.15", "protocolName": "Cisplatin on A549"}
ROWS = "BCDEFG"
VEHICLE_COLUMN = 11
DRUG_COLUMNS = list(range(3, 11))


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "A549 cells")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (3, 6)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    cisplatin = [tubes.wells()[i] for i in range(8)]
    dmso = tubes["D6"]

    def well(row, column):
        return plate.wells_by_name()[row + str(column)]

    for row in ROWS:
        p20.transfer(5, dmso, well(row, VEHICLE_COLUMN), new_tip="always")
    for drug, column in zip(cisplatin, DRUG_COLUMNS):
        for row in ROWS:
            p20.transfer(5, drug, well(row, column), new_tip="always")
