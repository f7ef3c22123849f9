# expect: cell_treatment pass CELL-2!
"""Medium change, then compound: columns 1 and 2 vehicle control, columns 3 to 12 compound.

The old medium goes into the waste reservoir.
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", s) for s in ("7", "8", "9")]
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "HepG2 cells")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "2", "trough")
    waste = protocol.load_labware("nest_12_reservoir_15ml", "3", "waste reservoir")
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    medium, dmso, compound = trough["A1"], trough["A2"], trough["A3"]
    for number, column in enumerate(plate.columns()):
        m300.transfer(100, column[0], waste.wells()[number // 4].top(), new_tip="always")
    m300.pick_up_tip()
    for column in plate.columns():
        m300.transfer(80, medium, column[0].top(), new_tip="never")
    m300.drop_tip()
    for column in plate.columns()[:2]:
        m300.transfer(20, dmso, column[0], new_tip="always")
    for column in plate.columns()[2:]:
        m300.transfer(20, compound, column[0], new_tip="always")
