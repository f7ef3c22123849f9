# expect: cell_treatment pass
metadata = {"protocolName": "Oligodendrocytes", "apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "oligodendrocyte cells")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    stocks = {"vehicle": tubes["A1"], "drug": {2: tubes["B1"], 4: tubes["B2"], 8: tubes["B3"]}}
    vehicle_wells = plate.columns()[0][:4]
    pip.transfer(30, stocks["vehicle"], vehicle_wells, new_tip="always")
    pip.pick_up_tip()
    for number, dose in enumerate(sorted(stocks["drug"])):
        for well in plate.columns()[number + 1][:4]:
            pip.transfer(30, stocks["drug"][dose], well, new_tip="never")
    pip.drop_tip()
