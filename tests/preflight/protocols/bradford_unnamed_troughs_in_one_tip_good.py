
metadata = {"protocolName": "Bradford", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "plate")
    trough = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tips = [ctx.load_labware("opentrons_96_filtertiprack_200ul", s) for s in (4, 5, 6)]
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    cols = plate.columns()
    standards = rack.rows()[0][:5]
    samples = rack.rows()[1][:4]
    dye = trough["A1"]
    pip.pick_up_tip()
    pip.transfer(20, trough["A2"], cols[2][:3], new_tip="never")
    pip.transfer(20, trough["A3"], cols[3][:3], new_tip="never")
    pip.drop_tip()
    pip.transfer(20, standards, cols[0][:5], new_tip="always")
    pip.transfer(20, samples, cols[1][:4], new_tip="always")
    for well in cols[0][:5] + cols[1][:4] + cols[2][:3] + cols[3][:3]:
        pip.transfer(180, dye, well, mix_after=(2, 100))
