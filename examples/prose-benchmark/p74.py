"""Paclitaxel on MDA-MB-231, two days.

Layout of the cell plate: row A paclitaxel free, rows B-D paclitaxel.
"""

metadata = {"apiLevel": "2.14"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "3")
    plate = protocol.load_labware("corning_24_wellplate_3.4ml_flat", "1", "cell plate")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
    paclitaxel = tubes["A1"]
    for row in plate.rows():
        for well in row:
            p300.transfer(50, paclitaxel, well, new_tip="always")
