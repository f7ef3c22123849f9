# expect: pcr warn PCR-4
"""16S PCR, one stamp of the DNA plate.

DNA plate (slot 1): columns 1-11 soil DNA, column 12 extraction water = NTC
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    soil = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "DNA plate")
    target = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "PCR")
    mix = ctx.load_labware("nest_12_reservoir_15ml", 3)["A1"]  # master mix
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5, 6)]
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=tips)

    for column in target.rows()[0]:
        m20.transfer(18, mix, column, new_tip="always")
    for source, column in zip(soil.rows()[0], target.rows()[0]):
        m20.transfer(2, source, column, new_tip="always")
    # column 11 was thin: once more
    m20.transfer(2, soil["A11"], target["A12"])
