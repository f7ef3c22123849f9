# expect: bradford fail BRD-2
metadata = {"protocolName": "BCA from CSV", "apiLevel": "2.13"}
DATA = """A1,A1,standard,0
B1,A2,standard,250
C1,A3,standard,1000
D1,B1,sample,
E1,B2,sample,
F1,B3,sample,"""


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3)
    res = ctx.load_labware("nest_12_reservoir_15ml", 6)
    p = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    rows = [line.split(",") for line in DATA.splitlines()]
    working_reagent = res["A1"]
    p.pick_up_tip()
    for dest, src, kind, conc in rows:
        p.aspirate(25, rack[src])
        p.dispense(25, plate[dest])
    p.drop_tip()
    for dest, src, kind, conc in rows:
        p.transfer(200, working_reagent, plate[dest], mix_after=(2, 100))
