# expect: cell_treatment pass CELL-1!
"""Tamoxifen and estradiol on MCF-7.

Cells: column 1 untreated, column 2 vehicle (rows A/B DMSO, rows C/D ethanol), columns 3-4 tamoxifen,
columns 5-6 estradiol.
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "6")
    cells = protocol.load_labware("corning_24_wellplate_3.4ml_flat", "1", "MCF-7 cells")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "tubes")
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
    dmso, ethanol, tamoxifen, estradiol = (tubes[spot] for spot in ("A1", "A2", "B1", "B2"))
    for well in cells.columns()[1][:2]:
        p300.transfer(30, dmso, well, new_tip="always")
    for well in cells.columns()[1][2:]:
        p300.transfer(30, ethanol, well, new_tip="always")
    for column in (2, 3):
        for well in cells.columns()[column]:
            p300.transfer(30, tamoxifen, well, new_tip="always")
    for column in (4, 5):
        for well in cells.columns()[column]:
            p300.transfer(30, estradiol, well, new_tip="always")
