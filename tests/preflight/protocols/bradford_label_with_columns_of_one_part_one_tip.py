# expect: bradford fail BRD-2
"""Eluates of a nickel plate beside a column of standards, which came from the shaker together."""

metadata = {"apiLevel": "2.14", "protocolName": "Bradford, nickel eluates"}


def run(ctx):
    source = ctx.load_labware("nest_96_wellplate_2ml_deep", 4, "ovalbumin col 12 + eluates")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 5)
    dye = ctx.load_labware("nest_1_reservoir_195ml", 6, "Bradford dye")["A1"]
    small = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    large = ctx.load_labware("opentrons_96_filtertiprack_200ul", 2)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[small])
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[large])
    tops = list(zip(source.rows()[0], plate.rows()[0], strict=True))

    m20.pick_up_tip()
    for there, here in [tops[11], *tops[:6]]:
        m20.aspirate(8, there)
        m20.dispense(8, here)
    m20.drop_tip()
    for _, here in [tops[11], *tops[:6]]:
        m300.transfer(180, dye, here, new_tip="always", mix_after=(3, 100))
