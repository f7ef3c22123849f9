# expect: cell_treatment pass
from opentrons import protocol_api

metadata = {"protocolName": "MTT, K562 cells", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "cell plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    res = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tips = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (4, 5)]
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=tips)
    # rows A-C: drug in triplicate, vehicle last, fresh tips
    # row H: vehicle
    vehicle, drug, medium = res["A1"], res["A2"], res["A3"]
    for r in plate.rows()[:3]:
        p300.transfer(20, drug, r[:10])
    p300.transfer(20, vehicle, plate.rows()[7][:10])
