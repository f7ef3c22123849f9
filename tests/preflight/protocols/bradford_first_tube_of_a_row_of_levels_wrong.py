# expect: bradford fail BRD-1
"""Protein of milk samples. Rack: A1-A6 BSA 0, 100, 200, 400, 800, 1600 ug/mL; row C samples."""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "4")
    large = protocol.load_labware("opentrons_96_tiprack_300ul", "5")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "rack")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "3", "Bradford reagent")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    m300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[large])
    p20.pick_up_tip()
    for tube, well in zip(rack.rows()[0][::-1], plate.columns()[0]):
        p20.transfer(5, tube, well, new_tip="never")
    p20.drop_tip()
    for tube, well in zip(rack.rows()[2], plate.columns()[1]):
        p20.transfer(5, tube, well, new_tip="always")
    for column in plate.columns()[:2]:
        m300.transfer(200, trough["A1"], column[0], mix_after=(3, 100), new_tip="always")
