# expect: cell_treatment pass CELL-1! CELL-2! CELL-3! CELL-4!
"""Bleomycin on fibroblasts

Doses (tube: column of the culture plate, rows C-F)
  vial C1   0.5 uM   column 9
  vial C2   5 uM     column 8
  vial C3   50 uM    column 7
  vial C4   saline   column 10 (vehicle controls)
"""

metadata = {"protocolName": "Bleomycin", "apiLevel": "2.13"}


def run(protocol):
    f = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    v = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 8)
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])

    p300.transfer(40, v["C4"], f.columns()[9][2:6], new_tip="always")
    p300.pick_up_tip()
    for vial, column in (("C1", 8), ("C2", 7), ("C3", 6)):
        for well in f.columns()[column][2:6]:
            p300.aspirate(40, v[vial])
            p300.dispense(40, well)
    p300.drop_tip()
