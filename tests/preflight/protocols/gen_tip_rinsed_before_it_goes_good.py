# expect: generic pass
"""Plate copy; every tip is rinsed in bleach before it goes into the bin."""

metadata = {"apiLevel": "2.13", "protocolName": "Sample plate copy"}


def run(protocol):
    p300 = protocol.load_instrument(
        "p300_multi_gen2",
        "left",
        tip_racks=[protocol.load_labware("opentrons_96_tiprack_300ul", 1)],
    )
    samples = protocol.load_labware("nest_96_wellplate_2ml_deep", 2, "sample plate")
    copies = protocol.load_labware("nest_96_wellplate_200ul_flat", 3, "destination plate")
    bleach = protocol.load_labware("agilent_1_reservoir_290ml", 4, "bleach reservoir")["A1"]
    for source, destination in zip(samples.rows()[0], copies.rows()[0]):
        p300.pick_up_tip()
        p300.aspirate(50, source)
        p300.dispense(50, destination)
        p300.mix(2, 200, bleach)
        p300.drop_tip()
