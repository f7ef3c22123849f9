# expect: cell_treatment warn CELL-1
"""Cisplatin auf A2780-Zellen, 48 h.

Zellplatte: Spalte 1 ohne Cisplatin, Spalten 2 bis 4 Cisplatin.
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "7")
    platte = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "Zellplatte")
    rinne = protocol.load_labware("nest_12_reservoir_15ml", "2")
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    cisplatin = rinne["A1"]
    for spalte in range(4):
        m300.transfer(40, cisplatin, platte.columns()[spalte][0], new_tip="always")
