# expect: generic fail GEN-3
"""Buffer plates in two rounds; the trough is filled up between them, the plate stays."""

metadata = {"protocolName": "Buffer aliquots", "apiLevel": "2.13"}


def run(ctx):
    trough = ctx.load_labware("nest_1_reservoir_195ml", 2)
    plate = ctx.load_labware("nest_96_wellplate_200ul_flat", 3)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    buffer = trough["A1"]
    p300.transfer(120, buffer, plate.wells()[:8], new_tip="once")
    ctx.pause("Please top up the reservoir with fresh buffer and resume")
    p300.transfer(120, buffer, plate.wells()[:8], new_tip="once")
