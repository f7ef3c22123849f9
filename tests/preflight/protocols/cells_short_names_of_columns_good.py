# expect: cell_treatment pass
# HT-29, 90 ul per well
# dose plate: c1 vehicle, c2-5 the inhibitor, c6 empty
# cells: c1 vehicle ctrl, c2-5 inhibitor, c6 untreated
metadata = {"apiLevel": "2.12"}


def run(ctx):
    src = ctx.load_labware("nest_96_wellplate_2ml_deep", 4, "dose plate")
    ht29 = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "HT-29")
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", 2)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    for k in range(5):
        m20.transfer(10, src.rows()[0][k], ht29.rows()[0][k], mix_after=(2, 15))
