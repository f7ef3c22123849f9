# expect: generic fail GEN-3
"""Three places in one and the same well."""

from opentrons.types import Point

metadata = {"protocolName": "Buffer onto spots", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 3)
    buffer = protocol.load_labware("nest_1_reservoir_195ml", 5)["A1"]
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    p300.pick_up_tip()
    for step in range(3):
        p300.aspirate(150, buffer)
        p300.dispense(150, plate["A1"].top().move(Point(x=step)))
    p300.drop_tip()
