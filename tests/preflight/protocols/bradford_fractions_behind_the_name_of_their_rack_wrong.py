# expect: bradford fail BRD-1
"""Protein in the fractions of a column, by Bradford.

tube rack, standards: A1..A5 = BSA 1000, 500, 250, 125, 0 ug/mL
tube rack, fractions: C1..C6 = fractions 7 to 12
plate: rows A and C, each tube into the well of its name
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "4")
    large = protocol.load_labware("opentrons_96_tiprack_300ul", "5")
    source = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "3", "Bradford reagent")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])
    first, third = plate.rows()[0][:5], plate.rows()[2][:6]
    p20.pick_up_tip()
    for tube, well in zip(source.rows()[0][:5], first):
        p20.transfer(5, tube, well, new_tip="never")
    p20.drop_tip()
    for tube, well in zip(source.rows()[2], third):
        p20.transfer(5, tube, well, new_tip="always")
    for well in first + third:
        p300.transfer(200, trough["A1"], well, mix_after=(3, 100), new_tip="always")
