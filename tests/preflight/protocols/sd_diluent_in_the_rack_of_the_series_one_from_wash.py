# expect: serial_dilution fail SD-4
"""Ferritin, two-fold in tubes."""

metadata = {"protocolName": "Serial dilution of ferritin", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    diluent, wash, stock = rack["D6"], rack["D5"], rack["D1"]
    tubes = rack.rows()[0]

    p300.transfer(200, diluent, tubes[1:5], new_tip="once")
    p300.transfer(200, wash, tubes[5], new_tip="once")
    p300.transfer(400, stock, tubes[0])
    for left, right in zip(tubes[:5], tubes[1:]):
        p300.transfer(200, left, right, mix_after=(4, 150), new_tip="always")
