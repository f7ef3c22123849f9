# expect: cell_treatment fail CELL-1
"""Zanubrutinib on two cell lines of lymphoma, 72 h."""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "6")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "cells")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
    zanubrutinib, dmso = tubes["A1"], tubes["B1"]
    dmso_control = plate.columns()[0][:4]
    for well in dmso_control:
        p300.transfer(20, dmso, well, new_tip="always")
    for well in plate.columns()[0][3:] + plate.columns()[1]:
        p300.transfer(20, zanubrutinib, well, new_tip="always")
