# expect: pcr pass PCR-6! PCR-1!
"""16S PCR; amplicons into one tube, the NTC's product into a tube for the gel."""

metadata = {"apiLevel": "2.16", "protocolName": "16S PCR"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (7, 10)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    soil = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, "soil DNA")
    pcr = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3, "PCR plate")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 5)
    master_mix, water, amplicon_pool, ntc_for_gel = (rack[n] for n in ("A1", "B1", "D6", "D5"))
    reactions, ntc = pcr.wells()[:6], pcr.wells()[6]
    p20.transfer(20, master_mix, [*reactions, ntc], new_tip="once")
    p20.transfer(5, water, ntc, mix_after=(3, 15))
    p20.transfer(5, soil.wells()[:6], reactions, mix_after=(3, 15), new_tip="always")
    p20.transfer(6, reactions, amplicon_pool, new_tip="always")
    p20.transfer(6, ntc, ntc_for_gel)
