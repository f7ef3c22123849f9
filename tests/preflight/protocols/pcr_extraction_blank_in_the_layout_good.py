# expect: pcr pass PCR-1! PCR-2! PCR-4!
# eDNA of a pond, qPCR
# tubes: A1 master mix, B1-B5 eDNA, D1 water
# plate: A1-D1 filters, E1 filtration blank, F1 NTC

metadata = {"apiLevel": "2.12"}


def run(ctx):
    s = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 4)
    r = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 1)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 2)
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    p20.transfer(18, r["A1"], s.columns()[0][:6])
    p20.transfer(2, r["D1"], s["F1"])
    for tube, well in zip(r.rows()[1][:5], s.columns()[0][:5]):
        p20.transfer(2, tube, well)
