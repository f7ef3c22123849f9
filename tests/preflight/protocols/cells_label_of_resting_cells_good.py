# expect: cell_treatment pass
from opentrons import protocol_api

metadata = {"protocolName": "PBMC stimulation", "apiLevel": "2.13"}


def run(ctx):
    resting = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "resting PBMC")
    res = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 4)
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[tips])
    medium, vehicle, ionomycin = res["A1"], res["A2"], res["A3"]
    for col in resting.columns()[:2]:
        m300.transfer(20, vehicle, col)
    for col in resting.columns()[2:8]:
        m300.transfer(20, ionomycin, col)
    m300.transfer(30, medium, [w.top() for w in resting.rows()[0][:8]])
