# expect: pcr warn PCR-4
"""
   Species test, meat products      sheet 12
   Plate map (slot 2)      all in duplicate

         1     2     3
     A   X1    X3    Z
     B   X1    X3    Z
     C   X2    X4
     D   X2    X4

     X1 .. X4   meat extracts
     Z          negative control, water instead of extract

   Tubes (slot 4, 24 places)
     A1  master mix, 600 uL        B1  water, 500 uL
     A2  X1     B2  X2     C2  X3     D2  X4    (60 uL each)
     A3  X1, diluted 1:10, 60 uL
"""

metadata = {"apiLevel": "2.15"}


def run(ctx):
    plate = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 4)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 7)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    pairs = [plate.columns()[c][r : r + 2] for c in (0, 1) for r in (0, 2)]
    pairs.append(plate.columns()[2][:2])
    p20.pick_up_tip()
    for pair in pairs:
        for w in pair:
            p20.transfer(15, rack["A1"], w, new_tip="never")
    p20.drop_tip()
    for s, pair in zip(rack.wells()[4:9], pairs):
        for w in pair:
            p20.transfer(5, s, w, new_tip="always", mix_after=(2, 10))
