# expect: generic pass
"""Libraries go to a merging plate and from there into a pool that holds Tris; its tips are reused."""

metadata = {"apiLevel": "2.13", "protocolName": "Library pooling"}


def run(protocol):
    m20 = protocol.load_instrument(
        "p20_multi_gen2", "left", tip_racks=[protocol.load_labware("opentrons_96_tiprack_20ul", 1)]
    )
    tris = protocol.load_labware("nest_12_reservoir_15ml", 2)["A1"]
    libraries = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3, "library plate")
    merged = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 4, "merging plate")
    pool = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 5, "pooling plate")["A1"]
    m20.pick_up_tip()
    m20.transfer(10, tris, pool, new_tip="never")
    m20.return_tip()
    m20.reset_tipracks()
    for source, destination in zip(libraries.rows()[0][:4], merged.rows()[0]):
        m20.pick_up_tip()
        m20.mix(5, 15, source)
        m20.transfer(15, source, destination, new_tip="never")
        m20.transfer(2, destination, pool.top(), new_tip="never")
        m20.drop_tip()
