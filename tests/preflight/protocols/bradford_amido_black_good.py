# expect: bradford pass BRD-4!
"""Amido black on milk whey."""

metadata = {"protocolName": "Whey, amido black", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    tips_large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 2)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3, "whey")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 5)
    amido_black = protocol.load_labware("nest_1_reservoir_195ml", 6)["A1"]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips_large])
    wells = plate.columns()[3]

    p20.transfer(10, rack.wells()[:8], wells, new_tip="always")
    p300.transfer(150, amido_black, wells, mix_after=(3, 100), new_tip="always")
