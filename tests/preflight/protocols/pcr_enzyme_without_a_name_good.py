# expect: pcr pass
from opentrons import protocol_api

metadata = {"protocolName": "One-step RT-qPCR with no-RT controls", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5, 6)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    buffer_mix, ss4, water = tubes["A1"], tubes["A2"], tubes["A3"]
    rna = [tubes[w] for w in ("B1", "B2", "B3", "B4")]
    with_rt, no_rt = plate.rows()[0][:5], plate.rows()[1][:5]
    master_mix = buffer_mix
    p20.transfer(12, master_mix, with_rt + no_rt, new_tip="once")
    p20.transfer(3, ss4, with_rt, new_tip="once")
    p20.transfer(3, water, no_rt, new_tip="once")
    for tube, a, b in zip(rna, with_rt, no_rt):
        p20.transfer(5, tube, [a, b], new_tip="always")
    # last pair: water instead of RNA
    p20.transfer(5, water, [with_rt[4], no_rt[4]], new_tip="once")
