# expect: cell_treatment pass
from opentrons import protocol_api

metadata = {"protocolName": "Starved A549: EGF and erlotinib", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "starved A549")
    res = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 4)
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[tips])
    # serum-starved overnight; vehicle in column 1, erlotinib in columns 2-6
    vehicle, erlotinib = res["A1"], res["A2"]
    m300.transfer(50, vehicle, plate.columns()[0])
    for col in plate.columns()[1:6]:
        m300.transfer(50, erlotinib, col)
