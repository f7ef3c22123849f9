# expect: serial_dilution fail SD-3
"""Colony counts: tenfold dilutions of an overnight culture in saline, columns 1 to 6."""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    block = ctx.load_labware("nest_96_wellplate_2ml_deep", 2, "dilution block")
    saline = ctx.load_labware("nest_1_reservoir_195ml", 3, "saline")["A1"]
    culture = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 5, "culture")["A1"]
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    row = block.rows()[0][:6]
    p300.transfer(100, culture, row[0])
    for well in row:
        p300.transfer(900, saline, well.top(), new_tip="once")
    p300.pick_up_tip()
    p300.mix(5, 250, row[0])
    p300.drop_tip()
    for above, below in zip(row, row[1:]):
        p300.transfer(100, above, below, mix_after=(5, 250))
