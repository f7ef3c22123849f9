# expect: generic pass GEN-1!
"""Nutrient analysis: every river water sample into its well."""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "4")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "nitrate plate")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "river water")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    for tube, well in zip(rack.wells()[:12], plate.rows()[0]):
        p300.transfer(150, tube, well, new_tip="always")
