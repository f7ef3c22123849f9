# expect: pcr pass
from opentrons import protocol_api

metadata = {"protocolName": "qPCR with background wells", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5, 6)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    # samples in rows A and B; wells H1-H3 hold water alone, for the optical background of the plate
    mm, water = tubes["A1"], tubes["A2"]
    samples = tubes.rows()[1]
    p20.transfer(15, mm, plate.rows()[0][:6], new_tip="once")
    for sample, well in zip(samples, plate.rows()[0]):
        p20.transfer(5, sample, well)
    p20.transfer(5, water, [plate["H1"], plate["H2"], plate["H3"]])
