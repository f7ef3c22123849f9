metadata = {"protocolName": "Pool libraries, then aliquot the pool", "apiLevel": "2.15"}


def run(protocol):
    p = protocol.load_instrument(
        "p300_single_gen2",
        "left",
        tip_racks=[protocol.load_labware("opentrons_96_tiprack_300ul", 4)],
    )
    libs = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, "libraries")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    pool = tubes["A1"]
    p.consolidate(30, libs.columns()[0] + libs.columns()[1], pool, mix_after=(3, 100))
    p.distribute(20, pool, tubes.columns()[2])
