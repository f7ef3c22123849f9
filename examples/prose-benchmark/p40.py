# Silica columns, plate format. Slot 1 holds the trough, slot 2 the deep-well plate.
# binding buffer (res A1) goes onto the samples (plate A1-H1), mixed well by well

metadata = {"protocolName": "Bind", "apiLevel": "2.13"}


def run(ctx):
    trough = ctx.load_labware("nest_12_reservoir_15ml", 1)
    deep = ctx.load_labware("nest_96_wellplate_2ml_deep", 2)
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    for well in deep.columns()[0]:
        p300.pick_up_tip()
        for _ in range(2):
            p300.aspirate(150, trough["A1"])
            p300.dispense(150, well.top(2))
        p300.mix(4, 100, well)
        p300.drop_tip()
