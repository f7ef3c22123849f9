# expect: pcr pass PCR-2!
"""SYBR qPCR of barley cDNA.

cDNA strip = column 1 of the cDNA plate:
  A-G  samples
  H    water
"""

metadata = {"protocolName": "Barley qPCR", "apiLevel": "2.13"}


def run(ctx):
    cdna = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "cDNA plate")
    qpcr = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "qPCR plate")
    tube = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    master_mix = tube["A1"]

    for column in qpcr.columns()[:2]:
        p20.transfer(16, master_mix, column, new_tip="once")
    for source, first, second in zip(cdna.columns()[0], *qpcr.columns()[:2]):
        p20.transfer(4, source, [first, second], new_tip="always")
