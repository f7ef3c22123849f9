"""Protein in milk whey with Coomassie dye.

The trough on slot 11 holds the Coomassie dye, which must have warmed up to the temperature of
the room. The curve comes from the rack that we keep on slot 4, where A1 is the blank and A2 to
A5 are albumin of 50, 100, 200 and 400 ug/mL. The whey samples of six farms are in row B of the
same rack. On the plate in slot 1 the curve has row A, and the samples have row
C, in which nothing is diluted.
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    m = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    k = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    h = ctx.load_labware("nest_12_reservoir_15ml", 11)
    t1 = ctx.load_labware("opentrons_96_tiprack_20ul", 2)
    t2 = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t1])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[t2])

    p20.transfer(10, k.rows()[0][:5], m.rows()[0][:5], new_tip="always")
    p20.transfer(10, k.rows()[1], m.rows()[2][:6], new_tip="always")
    for well in [*m.rows()[0][:5], *m.rows()[2][:6]]:
        p300.transfer(200, h["A6"], well, mix_after=(2, 100), new_tip="always")
