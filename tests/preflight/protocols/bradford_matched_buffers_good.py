# expect: bradford pass
from opentrons import protocol_api

metadata = {"protocolName": "BCA with NaOH matched wells", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    res = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tips20 = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5)]
    tips300 = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (6, 7)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips20)
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=tips300)

    standards = [tubes[w] for w in ("A1", "A2", "A3", "A4", "A5", "A6")]   # BSA 0, 125, 250, 500, 1000, 2000 ug/ml
    dye = res["A1"]

    lysates = tubes.rows()[1]
    base_free, base = tubes["C1"], tubes["C2"]
    for s, w in zip(standards, plate.columns()[0]):
        p20.transfer(10, s, w)
    for s, w in zip(lysates, plate.columns()[1]):
        p20.transfer(10, s, w)
    p20.pick_up_tip()
    for src, w in ((base_free, "A4"), (base, "B4"), (base, "C4")):
        p20.transfer(10, src, plate[w], new_tip="never")
    p20.drop_tip()
    for c in (0, 1, 3):
        m300.transfer(200, dye, plate.columns()[c][0], mix_after=(3, 100))
