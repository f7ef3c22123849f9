# expect: generic pass
"""Buffer to every donor's plasma with a tip of its own."""

metadata = {"protocolName": "Dilute plasma 1:2 with buffer", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("nest_96_wellplate_2ml_deep", 5, label="plasma sample plate")
    storage = ctx.load_labware("nest_96_wellplate_2ml_deep", 6, label="for the freezer")
    buffer = ctx.load_labware("nest_1_reservoir_195ml", 2)["A1"]
    tips = [ctx.load_labware("opentrons_96_filtertiprack_200ul", slot) for slot in (3, 4)]
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    wells = plate.columns()[1]
    p300.transfer(150, buffer, wells, new_tip="always")
    for well, kept in zip(wells, storage.columns()[1]):
        p300.transfer(100, well, kept, mix_before=(3, 100))
