# expect: bradford pass
"""Protein content of bulk, sheet 3

1. Plate, slot 6
     column 1 ......... PBS, A1-H1 (blank)
     column 2 ......... albumin 200 ug/mL, A2-H2
     columns 3 to 4 ... samples, one well each
2. Trough, slot 5
     channel 1  PBS, 3 mL
     channel 2  albumin 200 ug/mL, 3 mL
     channel 9 Coomassie dye reagent, 14 mL
3. Sample plate, slot 2: columns 1 to 2, 100 uL, same order
"""

metadata = {"apiLevel": "2.14"}


def run(ctx):
    tr = ctx.load_labware("nest_12_reservoir_15ml", 5)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 6)
    sp = ctx.load_labware("nest_96_wellplate_200ul_flat", 2)
    racks = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (8, 9)]
    m = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=racks)
    to = plate.rows()[0]
    for s, d in zip(tr.wells()[:2] + sp.rows()[0][:2], to):
        m.transfer(25, s, d, new_tip="always")
    for d in to[:4]:
        m.transfer(200, tr["A9"], d, mix_after=(3, 120), new_tip="always")
