# expect: bradford pass
from opentrons import protocol_api

metadata = {"protocolName": "Bradford assay, turbidity wells", "apiLevel": "2.13"}


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

    samples = tubes.rows()[1]
    for s, w in zip(standards, plate.columns()[0]):
        p20.transfer(5, s, w)
    for s, w in zip(samples, plate.columns()[1]):
        p20.transfer(5, s, w)
    # column 12 stays without dye: 5 ul of saline, read for the plate's own absorbance
    p20.transfer(5, tubes["D6"], plate.columns()[11], new_tip="once")
    for c in plate.columns()[:2]:
        m300.transfer(200, dye, c[0], mix_after=(3, 100))
