# expect: generic pass

metadata = {"protocolName": "Aliquots of one liquid", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "plate")
    trough = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tips = [ctx.load_labware("opentrons_96_filtertiprack_200ul", s) for s in (4, 5, 6)]
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    cols = plate.columns()
    pip.pick_up_tip()
    for n in range(4):
        pip.transfer(30, plate.rows()[7][n], [plate.rows()[r][n] for r in range(3)], new_tip="never")
    pip.drop_tip()
