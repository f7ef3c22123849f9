# expect: generic pass
metadata = {"apiLevel": "2.14", "protocolName": "Resuspend and dilute"}


def run(ctx):
    """TE to 100 uM, then working stocks of 10 uM."""
    ordered = ctx.load_labware("nest_96_wellplate_200ul_flat", 1, "lyophilised oligos")
    working = ctx.load_labware("nest_96_wellplate_200ul_flat", 2, "10 uM")
    te = ctx.load_labware("nest_12_reservoir_15ml", 3, "TE")["A1"]
    tips = [ctx.load_labware("opentrons_96_filtertiprack_200ul", s) for s in (4, 5)]
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=tips)

    for column in ordered.columns()[:4]:
        m300.pick_up_tip()
        m300.aspirate(80, te)
        m300.dispense(80, column[0])
        m300.mix(5, 60, column[0])
        m300.drop_tip()
    for column in working.columns()[:4]:
        m300.transfer(90, te, column[0], new_tip="always")
    for source, target in zip(ordered.columns()[:4], working.columns()[:4]):
        m300.transfer(10, source[0], target[0], new_tip="always", mix_after=(3, 50))
