# expect: generic pass
"""Two washes; the plate in slot 3 is flicked out by hand between them."""

metadata = {"protocolName": "Buffer aliquots", "apiLevel": "2.13"}


def run(ctx):
    trough = ctx.load_labware("nest_1_reservoir_195ml", 2)
    plate = ctx.load_labware("nest_96_wellplate_200ul_flat", 3)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    buffer = trough["A1"]
    p300.transfer(120, buffer, plate.wells()[:8], new_tip="once")
    ctx.pause("Empty the plate in slot 3 over the sink and put it back")
    p300.transfer(120, buffer, plate.wells()[:8], new_tip="once")
