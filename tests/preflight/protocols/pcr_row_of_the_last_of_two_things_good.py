# expect: pcr pass
from opentrons import protocol_api

metadata = {"protocolName": "qPCR, controls in column 12", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5, 6)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    # column 12: NTC, positive control in row H
    # columns 1 and 2: samples
    mix, water, pos = tubes["A1"], tubes["A2"], tubes["A3"]
    samples = tubes.rows()[1] + tubes.rows()[2]
    wells = plate.columns()[0] + plate.columns()[1][:4]
    controls = plate.columns()[11]
    p20.transfer(15, mix, wells + controls, new_tip="once")
    for s, w in zip(samples, wells):
        p20.transfer(5, s, w)
    p20.transfer(5, water, controls[:7], new_tip="once")
    p20.transfer(5, pos, controls[7])
