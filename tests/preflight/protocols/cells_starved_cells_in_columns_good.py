# expect: cell_treatment pass
from opentrons import protocol_api

metadata = {"protocolName": "Hormone response, MCF-7", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "cell plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    res = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tips = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (4, 5)]
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=tips)

    # MCF-7, starved cells in columns 1-8 (phenol-red free medium, 48 h)
    # columns 1-2 ethanol vehicle; columns 3-8 estradiol
    ethanol, estradiol = res["A1"], res["A2"]
    for c in range(2):
        m300.transfer(25, ethanol, plate.columns()[c])
    for c in range(2, 8):
        m300.transfer(25, estradiol, plate.columns()[c])
