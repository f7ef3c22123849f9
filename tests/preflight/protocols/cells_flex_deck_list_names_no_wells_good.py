# expect: cell_treatment pass
"""
Compound R-3 on HT-29

Deck
  B1   50 uL tips
  C2   HT-29 cells in 96 wells
  D2   dose block, deep well
         column 1   vehicle (0.5 % DMSO)
         column 2   R-3, dose 1 uM       column 3   R-3, dose 10 uM

HT-29 cells
  column 1         untouched
  columns 2, 12    vehicle control
  columns 3-4      1 uM
  columns 5-6      10 uM
"""

metadata = {"protocolName": "R-3 on HT-29"}
requirements = {"robotType": "Flex", "apiLevel": "2.16"}


def run(protocol):
    protocol.load_trash_bin("A3")
    tips = protocol.load_labware("opentrons_flex_96_filtertiprack_50ul", "B1")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", "C2")
    block = protocol.load_labware("nest_96_wellplate_2ml_deep", "D2")
    pipette = protocol.load_instrument("flex_8channel_50", "left", tip_racks=[tips])
    for source, columns in ((1, (2, 12)), (2, (3, 4)), (3, (5, 6))):
        for column in columns:
            pipette.transfer(10, block[f"A{source}"], cells[f"A{column}"], new_tip="always")
