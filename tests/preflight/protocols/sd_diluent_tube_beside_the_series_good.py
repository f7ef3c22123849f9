# expect: serial_dilution pass
"""Ferritin, two-fold in tubes; the blank is taken from a tube of its own."""

metadata = {"protocolName": "Serial dilution of ferritin", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    trough = ctx.load_labware("nest_12_reservoir_15ml", 2)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    diluent, stock = rack["D6"], rack["D1"]
    tubes = rack.rows()[0]

    p300.transfer(900, trough["A1"], diluent)
    p300.transfer(200, trough["A1"], tubes[1:], new_tip="once")
    p300.transfer(50, diluent, rack["C1"])
    p300.transfer(400, stock, tubes[0])
    for left, right in zip(tubes[:5], tubes[1:]):
        p300.transfer(200, left, right, mix_after=(4, 150), new_tip="always")
