# expect: bradford fail BRD-1
"""Total protein, Flex

DECK
  B1  tips 50 uL      B2  tips 200 uL     A3  trash
  C2  reservoir, 12 channels: 3 = Bradford dye, 12 mL
  C3  reading plate
  D3  tubes
TUBES (D3), 300 uL in every tube
  A1 > A4   BSA 0, 0.2, 0.4, 0.8 mg/mL
  B1 > B6   unknown samples 1 to 6
PLATE (C3)
  rows A to D, columns 1-2    BSA from 0 (row A) up to 0.8 (row D), duplicates
  row A to row F, columns 3-4 unknowns 1 to 6, duplicates
"""

requirements = {"robotType": "Flex", "apiLevel": "2.18"}


def run(ctx):
    ctx.load_trash_bin("A3")
    k50 = ctx.load_labware("opentrons_flex_96_tiprack_50ul", "B1")
    k200 = ctx.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
    r = ctx.load_labware("nest_12_reservoir_15ml", "C2")
    p = ctx.load_labware("corning_96_wellplate_360ul_flat", "C3")
    t = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "D3")
    small = ctx.load_instrument("flex_1channel_50", "left", tip_racks=[k50])
    large = ctx.load_instrument("flex_1channel_1000", "right", tip_racks=[k200])
    small.pick_up_tip()
    for i in (3, 2, 1, 0):
        for j in (0, 1):
            small.transfer(10, t.rows()[0][i], p.rows()[i][j], new_tip="never")
    small.drop_tip()
    for i in range(6):
        small.pick_up_tip()
        for j in (2, 3):
            small.transfer(10, t.rows()[1][i], p.rows()[i][j], new_tip="never")
        small.drop_tip()
    for x in [p.rows()[i][j] for j in (0, 1) for i in range(4)] + [
        p.rows()[i][j] for j in (2, 3) for i in range(6)
    ]:
        large.transfer(190, r["A3"], x, mix_after=(3, 100), new_tip="always")
