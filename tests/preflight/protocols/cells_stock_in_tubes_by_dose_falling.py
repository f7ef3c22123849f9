# expect: cell_treatment fail CELL-4
metadata = {"protocolName": "Melanoma, one inhibitor", "apiLevel": "2.14"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "melanoma cells")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    inhibitor = ctx.define_liquid("inhibitor 10x", "", "#ff0000")
    for tube in tubes.rows()[0][1:4]:
        tube.load_liquid(inhibitor, 800)
    doses = {0.5: tubes["A2"], 5: tubes["A3"], 50: tubes["A4"]}
    vehicle, vehicle_wells = tubes["A1"], plate.columns()[0][:4]
    pip.transfer(10, vehicle, vehicle_wells, new_tip="always")
    pip.pick_up_tip()
    for n, dose in enumerate(sorted(doses, reverse=True)):
        pip.transfer(10, doses[dose], plate.columns()[n + 1][:4], new_tip="never")
    pip.drop_tip()
