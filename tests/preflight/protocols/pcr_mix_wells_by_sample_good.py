# expect: pcr pass
from opentrons import protocol_api

metadata = {"protocolName": "qPCR with mix wells named by sample", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5, 6)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    mm_source, water = tubes["A1"], tubes["A2"]
    tube_of = {"liver": tubes["B1"], "kidney": tubes["B2"]}
    mastermix = {"liver": plate["A1"], "kidney": plate["B1"], "NTC": plate["C1"]}
    p20.transfer(15, mm_source, list(mastermix.values()), new_tip="once")
    p20.pick_up_tip()
    p20.transfer(2, water, mastermix["NTC"], new_tip="never")
    p20.drop_tip()
    for organ, tube in tube_of.items():
        p20.pick_up_tip()
        p20.transfer(2, tube, mastermix[organ], mix_after=(3, 8), new_tip="never")
        p20.drop_tip()
