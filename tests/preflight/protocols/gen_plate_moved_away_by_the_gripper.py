from opentrons import protocol_api

metadata = {"protocolName": "Copy two source plates"}
requirements = {"robotType": "Flex", "apiLevel": "2.19"}


def run(protocol: protocol_api.ProtocolContext):
    tips = protocol.load_labware("opentrons_flex_96_tiprack_200ul", "A1")
    source_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", "C1", "sources 1")
    second_source_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", "D4", "sources 2")
    destination_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", "C2", "destinations")
    protocol.load_trash_bin("A3")
    pipette = protocol.load_instrument("flex_8channel_1000", "left", tip_racks=[tips])

    pipette.pick_up_tip()
    pipette.transfer(40, source_plate["A1"], destination_plate["A1"], new_tip="never")
    protocol.move_labware(source_plate, "D1", use_gripper=True)
    protocol.move_labware(second_source_plate, "C1", use_gripper=True)
    pipette.transfer(40, second_source_plate["A1"], destination_plate["A2"], new_tip="never")
    pipette.drop_tip()
    pipette.transfer(40, source_plate["A2"], destination_plate["A3"])
