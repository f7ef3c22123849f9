# expect: bradford pass BRD-1! BRD-3!
"""Bradford, urine of cats

Standards (slot 2, row C of the rack): C1 blank, C2 BSA 100, C3 BSA 200, C4 BSA 400, C5 BSA 800 ug/mL
Samples (slot 2, row D of the rack): D1-D6
Dye (slot 3, well A4)
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    a = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    b = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    c = ctx.load_labware("nest_12_reservoir_15ml", 3)
    t1 = ctx.load_labware("opentrons_96_tiprack_20ul", 4)
    t2 = ctx.load_labware("opentrons_96_tiprack_300ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t1])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[t2])
    p20.pick_up_tip()
    for one, other in zip(b.rows()[2][:5], a.rows()[0]):
        p20.aspirate(10, one)
        p20.dispense(10, other)
    p20.drop_tip()
    p20.transfer(10, b.rows()[3], a.rows()[1][:6], new_tip="always")
    for well in a.rows()[0][:5] + a.rows()[1][:6]:
        p300.transfer(200, c["A4"], well, mix_after=(2, 100), new_tip="always")
