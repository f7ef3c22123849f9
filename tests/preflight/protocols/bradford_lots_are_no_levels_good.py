# expect: bradford pass
"""Bradford; BSA tubes from weak to strong.

tubes: A1 lot 4120, B1 lot 310, C1 lot 95, D1 lot 2201
"""

metadata = {"apiLevel": "2.15", "protocolName": "Bradford"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "assay plate")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "BSA standards")
    dye = protocol.load_labware("nest_12_reservoir_15ml", 6, "Bradford reagent")["A1"]
    small = protocol.load_labware("opentrons_96_tiprack_20ul", 5)
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 4)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[small])
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[large])
    p20.transfer(5, rack.wells()[:4], plate.wells()[:4], new_tip="once")
    p300.transfer(250, dye, plate.wells()[:4], mix_after=(3, 150), new_tip="always")
