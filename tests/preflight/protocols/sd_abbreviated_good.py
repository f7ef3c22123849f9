# expect: serial_dilution pass
metadata = {"apiLevel": "2.12", "protocolName": "colistin 1:2"}


def run(ctx):
    pl = ctx.load_labware("nest_96_wellplate_200ul_flat", 1)
    res = ctx.load_labware("nest_12_reservoir_15ml", 2)
    tr = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (4, 5)]
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=tr)
    dil_w = res["A1"]
    stk = res["A2"]
    wst = res["A12"]
    cols = [c[0] for c in pl.columns()][:8]
    for c in cols[1:]:
        m300.transfer(90, dil_w, c)
    m300.transfer(180, stk, cols[0])
    for s, d in zip(cols, cols[1:]):
        m300.transfer(90, s, d, mix_after=(5, 80), new_tip="always")
    m300.transfer(90, cols[-1], wst)
