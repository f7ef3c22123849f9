# expect: cell_treatment pass CELL-1! CELL-2! CELL-4!
"""Paclitaxel on ovarian cells.

The plate is in slot 2. Its first column is the vehicle control, the second column 1 nM, the third
with 10 nM and the fourth with 100 nM paclitaxel. In the rack on slot 4, tube A1 is the vehicle
and tube A2 1 nM, tube A3 10 nM and tube A4 100 nM paclitaxel.
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    o = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    r = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    pip = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    pip.transfer(50, r["A1"], o.columns()[0])
    pip.pick_up_tip()
    for at in (1, 2, 3):
        for well in o.columns()[at]:
            pip.transfer(50, r.rows()[0][at], well, new_tip="never")
    pip.drop_tip()
