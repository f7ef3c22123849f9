# expect: pcr pass
from opentrons import protocol_api

metadata = {"protocolName": "PCR with layout in words", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5, 6)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    # columns 1-3: samples 1-3, one column each, 4 NTC wells follow in column 5; sample 4 is in column 4
    mix, water = tubes["A1"], tubes["A2"]
    samples = tubes.rows()[1][:4]
    p20.transfer(15, mix, [w for c in plate.columns()[:4] for w in c] + plate.columns()[4][:4], new_tip="once")
    for s, column in zip(samples, plate.columns()):
        p20.transfer(5, s, column, new_tip="always")
    p20.transfer(5, water, plate.columns()[4][:4], new_tip="once")
