# expect: pcr pass
from opentrons import protocol_api

metadata = {"protocolName": "Mixes in a dict, one per target", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5, 6)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    mixes = {"pos. ctrl": tubes["A1"], "template-free": tubes["A2"]}
    dna, water = tubes["B1"], tubes["B2"]
    p20.transfer(15, mixes["pos. ctrl"], plate.columns()[0][:4], new_tip="once")
    p20.transfer(15, mixes["template-free"], plate.columns()[1][:4], new_tip="once")
    p20.transfer(5, dna, plate.columns()[0][:4], new_tip="always")
    p20.transfer(5, water, plate.columns()[1][:4], new_tip="always")
