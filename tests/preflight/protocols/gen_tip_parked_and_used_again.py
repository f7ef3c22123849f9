"""Parked tips are taken up for another source."""

metadata = {"apiLevel": "2.13", "protocolName": "Cherrypicking with parked tips"}


def run(protocol):
    rack = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[rack])
    source_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 2, "source plate")
    dest_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 3, "destination plate")
    picks = [("A1", "B2"), ("C1", "B3"), ("E1", "B4")]
    for tip, (source, destination) in zip(rack.wells(), picks):
        p20.pick_up_tip(tip)
        p20.aspirate(8, source_plate[source])
        p20.dispense(8, dest_plate[destination])
        p20.return_tip()
    for tip, (source, destination) in zip(rack.wells(), reversed(picks)):
        p20.pick_up_tip(tip)
        p20.aspirate(8, source_plate[source])
        p20.dispense(8, dest_plate[destination])
        p20.drop_tip()
