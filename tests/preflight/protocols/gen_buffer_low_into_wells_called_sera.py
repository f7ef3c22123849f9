# expect: generic fail GEN-1 GEN-2
"""Buffer to every donor serum with one tip, whose end comes below the wells' tops."""

metadata = {"protocolName": "Dilute plasma 1:2 with buffer", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("nest_96_wellplate_2ml_deep", 5)
    storage = ctx.load_labware("nest_96_wellplate_2ml_deep", 6)
    buffer = ctx.load_labware("nest_1_reservoir_195ml", 2)["A1"]
    tips = [ctx.load_labware("opentrons_96_filtertiprack_200ul", slot) for slot in (3, 4)]
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    sera = plate.columns()[1]
    p300.transfer(150, buffer, sera, new_tip="once")
    for well, kept in zip(sera, storage.columns()[1]):
        p300.transfer(100, well, kept, mix_before=(3, 100))
