# expect: bradford pass BRD-1!
"""Bradford curve, one tip for all standards."""

metadata = {"apiLevel": "2.13"}
LEVELS = [0, 50, 100, 250, 500, 1000]  # ug/mL BSA


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "4")
    large = protocol.load_labware("opentrons_96_tiprack_300ul", "5")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "BSA standards")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "3", "Bradford reagent")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    m300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[large])
    p20.pick_up_tip()
    for i in range(len(LEVELS)):
        p20.transfer(5, rack.wells()[i], plate.wells()[i], new_tip="never")
    p20.drop_tip()
    m300.transfer(200, trough["A1"], plate["A1"], mix_after=(3, 100))
