"""Phosphatase potency, working sheet

Contents of the reservoir (label "res", slot 4)
   A1 ....... assay diluent, 12 mL
   A2 ....... assay diluent, 12 mL
   A5 ....... stop solution, 8 mL
Contents of the plate (label "lots", slot 6), row A through row H = 8 lots
   column 1 ...... lot as received, 200 uL
   columns 2-6 ... 1:2 dilutions, 100 uL diluent + 100 uL of the column before
"""

metadata = {"apiLevel": "2.14"}


def run(ctx):
    d = ctx.load_labware("corning_96_wellplate_360ul_flat", 6, "lots")
    r = ctx.load_labware("nest_12_reservoir_15ml", 4, "res")
    t = ctx.load_labware("opentrons_96_tiprack_300ul", 9)
    p = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[t])
    row = d.rows()[0]
    for name, wells in (("A1", row[1:3]), ("A5", row[3:6])):
        p.pick_up_tip()
        for w in wells:
            p.transfer(100, r[name], w, new_tip="never")
        p.drop_tip()
    for n in range(5):
        p.transfer(100, row[n], row[n + 1], mix_after=(4, 80), new_tip="always")
