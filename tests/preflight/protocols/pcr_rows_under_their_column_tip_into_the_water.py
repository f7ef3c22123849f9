# expect: pcr fail PCR-2 PCR-5
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
    for source, first, second in zip(cdna.columns()[0][:6], *qpcr.columns()[:2]):
        p20.transfer(4, source, [first, second], new_tip="always")
    p20.pick_up_tip()
    for row in (6, 7):
        for column in qpcr.columns()[:2]:
            p20.transfer(4, cdna.columns()[0][row], column[row], mix_after=(2, 8), new_tip="never")
    p20.drop_tip()
