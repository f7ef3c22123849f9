# expect: generic pass
"""Colour plate for an open day: water first with one tip, then the ink with new tips."""

metadata = {"apiLevel": "2.14", "protocolName": "colour plate"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "colours")
    pots = protocol.load_labware("opentrons_6_tuberack_falcon_50ml_conical", 2)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    water, ink = pots["A1"], pots["A2"]

    p300.pick_up_tip()
    for step, well in enumerate(plate.wells()[:24]):
        p300.aspirate(30 + 10 * step, water)
        p300.dispense(30 + 10 * step, well)
    p300.drop_tip()
    for step, well in enumerate(plate.wells()[:24]):
        p300.transfer(270 - 10 * step, ink, well, new_tip="always")
