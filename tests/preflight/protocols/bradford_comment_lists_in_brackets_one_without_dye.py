# expect: bradford fail BRD-3
metadata = {"protocolName": "Coomassie, duplicates", "apiLevel": "2.13"}


def run(ctx):
    rk = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    pl = ctx.load_labware("nest_96_wellplate_200ul_flat", 1)
    rs = ctx.load_labware("nest_12_reservoir_15ml", 7)
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (2, 5)]
    large = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[large])
    stds = dict(zip((0, 125, 250, 500, 1000), rk.wells()))
    unk = rk.rows()[3]
    dye = rs["A1"]
    # duplicates: columns 1+2 (bg, stds), 3+4 (unk)
    for n, tube in enumerate(stds.values()):
        p20.transfer(5, tube, pl.rows()[n][:2])
    for n, tube in enumerate(unk):
        p20.transfer(5, tube, pl.rows()[n][2:4])
    used = pl.wells()[:5] + pl.wells()[8:12] + pl.wells()[16:22] + pl.wells()[24:30]
    p300.transfer(150, dye, used, mix_after=(3, 100), new_tip="always")
