"""Sunitinib on renal cells.

Plate: DMSO D1-D6 and E1-E6, sunitinib F1-F6 and G1-G6
"""

metadata = {"protocolName": "Sunitinib", "apiLevel": "2.13"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "786-O cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    dmso, sunitinib = rack["A1"], rack["A2"]
    rows = plate.rows_by_name()
    p20.transfer(5, dmso, rows["D"][:6] + rows["E"][:6], new_tip="always")
    p20.transfer(5, sunitinib, rows["D"][5:6] + rows["F"][:6] + rows["G"][:6], new_tip="always")
