"""Fibroblasts under cadmium. Stock plate: columns 1-4 rising cadmium, column 12 vehicle."""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    stock = ctx.load_labware("nest_96_wellplate_2ml_deep", 3, "stock plate")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "fibroblasts")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    drugs = stock.rows()[0][:4]
    vehicle, vehicle_wells = stock["A12"], plate.columns()[1][:4]
    pip.transfer(10, vehicle, vehicle_wells, new_tip="always")
    pip.pick_up_tip()
    for number in (3, 2, 1, 0):
        for well in plate.columns()[number + 2][:4]:
            pip.transfer(10, drugs[number], well, new_tip="never")
    pip.drop_tip()
