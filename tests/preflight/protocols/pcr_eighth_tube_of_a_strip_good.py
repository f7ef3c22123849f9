# expect: pcr pass PCR-4!
"""Sugar beet qPCR, two assays.

strip 6: cDNA 1-7, 8th tube (H6) nuclease free water
qPCR plate: columns 1 and 2; H1 and H2 are the NTC
"""

metadata = {"protocolName": "Sugar beet, two assays", "apiLevel": "2.13"}


def run(ctx):
    cdna = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "cDNA strips")
    qpcr = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "qPCR plate")
    mixes = ctx.load_labware("nest_12_reservoir_15ml", 3, "master mixes")
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=tips)

    for mix, head in zip(mixes.wells(), qpcr.rows()[0][:2]):
        m20.transfer(15, mix, head)
    for head in qpcr.rows()[0][:2]:
        m20.transfer(5, cdna.rows()[0][5], head)
