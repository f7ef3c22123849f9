# expect: pcr pass
metadata = {"protocolName": "RT-qPCR", "apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    p = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    rt_mix, no_rt_mix, water = tubes["A1"], tubes["A2"], tubes["A3"]
    rna = tubes.rows()[1][:4]
    wells, nrt, ntc = plate.columns()[0][:4], plate.columns()[1][:4], plate["H12"]
    p.transfer(18, rt_mix, wells + [ntc])
    p.transfer(18, no_rt_mix, nrt)
    for r, w, n in zip(rna, wells, nrt):
        p.pick_up_tip()
        p.transfer(2, r, w, new_tip="never")
        p.transfer(2, r, n, new_tip="never")
        p.drop_tip()
    p.transfer(2, water, ntc)
