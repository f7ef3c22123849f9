"""Etoposid auf Leukämiezellen

Zellplatte (Steckplatz 5): die ersten zwei Zeilen Vehikelkontrolle, die dritte und vierte Zeile
mit Etoposid 2 uM behandelt.
Röhrchen (Steckplatz 6): A1 Vehikel, B1 Etoposid 2 uM
"""

metadata = {"apiLevel": "2.14"}


def run(protocol):
    z = protocol.load_labware("corning_96_wellplate_360ul_flat", 5)
    g = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 6)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 8)
    pip = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    pip.transfer(30, g["A1"], z.rows()[0])
    pip.transfer(30, g["B1"], z.rows()[1] + z.rows()[2] + z.rows()[3])
