# expect: bradford pass BRD-1!
"""Bradford of yeast lysates.

Standards in the rack:

  tube     A1    A2    A3    A4    A5    A6
  gamma    1500  1000  500   250   125   0     (ug/mL; 0 = lysis buffer)
"""

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
    m300.transfer(200, trough["A1"], plate["A1"], mix_after=(3, 100))
