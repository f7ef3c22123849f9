# expect: pcr pass
metadata = {"apiLevel": "2.13"}
NTC_COL = 5
SAMPLE_COLS = list(range(1, 5))


def run(ctx):
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (1, 4, 7)]
    rack = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2, "reagents")
    dna = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3, "DNA templates")
    plate = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 5, "qPCR plate")
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    mm = rack["A1"]
    water = rack["A2"]
    wells = [w for c in SAMPLE_COLS for w in plate.columns()[c - 1]]
    negatives = plate.columns()[NTC_COL - 1][:6]
    p20.pick_up_tip()
    for w in wells + negatives:
        p20.transfer(15, mm, w.top(), new_tip="never")
    p20.drop_tip()
    p20.transfer(5, water, negatives, new_tip="once")
    for s, d in zip(dna.wells(), wells):
        p20.transfer(5, s, d, new_tip="always")
