# expect: serial_dilution pass
from opentrons import protocol_api

metadata = {"protocolName": "IgG serial dilution", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "stock A1 IgG 1 mg/ml, A2 EB")
    tips = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (4, 5)]
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=tips)

    series = plate.rows()[0][:8]
    p300.transfer(100, rack["A2"], series[1:], new_tip="once")
    p300.transfer(200, rack["A1"], series[0])
    for a, b in zip(series, series[1:]):
        p300.transfer(100, a, b, mix_after=(4, 80), new_tip="always")
