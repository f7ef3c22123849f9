# expect: serial_dilution fail SD-5
"""Broth dilution of an extract, columns 1 to 6."""

metadata = {"apiLevel": "2.15"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "dilution plate")
    trough = ctx.load_labware("nest_12_reservoir_15ml", 3)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    broth, extract = trough["A1"], trough["A3"]
    row = plate.rows()[0][:6]
    m300.transfer(100, broth, row, new_tip="once")
    m300.transfer(100, extract, row[0], mix_after=(4, 90))
    m300.pick_up_tip()
    for above, below in zip(row, row[1:]):
        m300.transfer(100, above, below, mix_after=(4, 90), new_tip="never")
    m300.drop_tip()

    # discard the surplus of column 6
    m300.pick_up_tip()
    m300.aspirate(100, row[-1])
    m300.drop_tip()
