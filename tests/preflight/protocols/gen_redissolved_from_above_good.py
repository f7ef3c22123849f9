"""Dried eluates are redissolved from above; how much is left in the wells nobody says."""

metadata = {"protocolName": "Mass spec sample prep", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    collection_plate = protocol.load_labware("nest_96_wellplate_2ml_deep", 1, "collection plate")
    mq = protocol.load_labware("nest_12_reservoir_15ml", 2)["A5"]
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    samples_collection = collection_plate.rows()[0][:6]

    m300.pick_up_tip()
    for column in samples_collection:
        m300.aspirate(150, mq)
        m300.dispense(150, column.top(-1))
    m300.drop_tip()
