# expect: bradford pass
"""Bradford of 10 eluates."""

from opentrons import protocol_api

metadata = {"protocolName": "Bradford, column eluates"}
requirements = {"robotType": "OT-2", "apiLevel": "2.16"}


def run(protocol: protocol_api.ProtocolContext):
    left = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "4")
    right = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "5")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "6")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "7")
    t20 = protocol.load_labware("opentrons_96_filtertiprack_20ul", "8")
    t200 = protocol.load_labware("opentrons_96_filtertiprack_200ul", "9")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[t200])

    standards = left.wells()[:6]
    dye = trough["A1"]
    standard_wells = plate.columns()[0][:6]
    other_wells = plate.columns()[1] + plate.columns()[2][:2]

    p20.transfer(5, standards, standard_wells, new_tip="always")
    p20.transfer(5, right.wells()[:10], other_wells, new_tip="always")
    for well in standard_wells + other_wells:
        p300.transfer(195, dye, well, mix_after=(3, 100), new_tip="always")
