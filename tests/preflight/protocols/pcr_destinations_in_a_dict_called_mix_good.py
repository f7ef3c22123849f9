# expect: pcr pass
from opentrons import protocol_api

metadata = {"protocolName": "Master mix destinations in a dict", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5, 6)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    mastermix, water = tubes["A1"], tubes["A2"]
    dna = {"s1": tubes["B1"], "s2": tubes["B2"], "s3": tubes["B3"]}
    mix_wells = {"sample 1": plate["A1"], "sample 2": plate["B1"], "sample 3": plate["C1"], "NTC": plate["D1"]}
    for well in mix_wells.values():
        p20.transfer(16, mastermix, well)
    p20.transfer(4, dna["s1"], mix_wells["sample 1"], mix_after=(2, 10))
    p20.transfer(4, dna["s2"], mix_wells["sample 2"], mix_after=(2, 10))
    p20.transfer(4, dna["s3"], mix_wells["sample 3"], mix_after=(2, 10))
    p20.transfer(4, water, mix_wells["NTC"])
