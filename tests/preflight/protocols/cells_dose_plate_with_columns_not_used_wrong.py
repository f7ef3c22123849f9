# expect: cell_treatment warn CELL-1 CELL-2
"""Etoposide on HCT116; the doses come from a plate made by hand.

Dose plate (deep well, 10x in medium):

  column 1      0.1 % DMSO, the vehicle
  columns 2-5   etoposide, 0.1 to 100 uM
  columns 6-12  etoposide of the second donor, for next week

Cell plate (flat, 2 000 cells a well):

  columns 1-2  vehicle control
  columns 3-6  etoposide, one dose in each
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "7")
    doses = protocol.load_labware("nest_96_wellplate_2ml_deep", "2", "dose plate")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "cell plate")
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    for column in range(6):
        source = doses.columns()[column][0]
        m300.transfer(20, source, cells.columns()[column][0], new_tip="always")
