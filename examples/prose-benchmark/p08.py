"""
Compounds on HeLa cells, 96 wells
Columns 2-9: compounds, 10 uM
Column 10: DMSO controls (A10-H10)
"""

metadata = {"protocolName": "Compounds on HeLa", "apiLevel": "2.12"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 7)]
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 5, "HeLa cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 6, "compounds")
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=tips)
    dmso = rack["D6"]

    p20.transfer(2, dmso, [cells[f"{row}10"] for row in "ABCDEFG"], new_tip="always")
    for tube, column in zip(rack.wells()[:8], cells.columns()[1:9]):
        p20.transfer(2, tube, column, new_tip="always")
