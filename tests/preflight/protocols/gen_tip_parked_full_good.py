# expect: generic pass
"""Liquids are drawn and parked in their tips first, and given off together afterwards."""

metadata = {"apiLevel": "2.13", "protocolName": "Cherrypicking with parked tips"}


def run(protocol):
    rack = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[rack])
    source_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 2, "source plate")
    dest_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 3, "destination plate")
    buffer = protocol.load_labware("nest_12_reservoir_15ml", 4)["A1"]
    picks = [("A1", "B2"), ("C1", "B3"), ("E1", "B2")]
    p20.starting_tip = rack["A12"]
    p20.distribute(5, buffer, dest_plate.wells()[:24])
    for tip, (source, _) in zip(rack.wells(), picks):
        p20.pick_up_tip(tip)
        p20.aspirate(8, source_plate[source])
        p20.return_tip()
    for tip, (_, destination) in zip(rack.wells(), picks):
        p20.pick_up_tip(tip)
        p20.dispense(8, dest_plate[destination])
        p20.drop_tip()
