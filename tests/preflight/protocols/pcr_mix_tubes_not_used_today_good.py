# expect: pcr pass
"""qPCR stock solutions. The mixes and the NTC tube are named for the next script; only primers move."""

metadata = {"apiLevel": "2.13", "protocolName": "qPCR primer dilution"}


def run(protocol):
    p20 = protocol.load_instrument(
        "p20_single_gen2", "left", tip_racks=[protocol.load_labware("opentrons_96_tiprack_20ul", 1)]
    )
    rack = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_screwcap", 2)
    mixes = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_screwcap", 3)
    strips = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 4)
    master_mix = mixes["A1"]
    ntc_mix = mixes["D6"]
    fwd_primer, rev_primer = rack["A1"], rack["A2"]
    p20.distribute(5, fwd_primer, strips.columns()[0])
    p20.distribute(5, rev_primer, strips.columns()[1])
