# expect: cell_treatment pass
from opentrons import protocol_api

metadata = {"protocolName": "Treatment of U2OS cells", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "cell plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    res = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tips = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (4, 5)]
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=tips)
    # odd columns of the first half get vehicle, all the others drug
    vehicle, drug, medium = res["A1"], res["A2"], res["A3"]
    for c in (0, 2, 4):
        m300.transfer(20, vehicle, plate.columns()[c][0])
    for c in (1, 3, 5, 6, 7, 8, 9, 10, 11):
        m300.transfer(20, drug, plate.columns()[c][0])
