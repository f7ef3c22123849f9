# expect: pcr pass
from opentrons import protocol_api

metadata = {"protocolName": "Colony PCR and fluorometry on one plate", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5, 6)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    mastermix, nfw = tubes["A1"], tubes["A2"]
    templates = [tubes[w] for w in ("C1", "C2", "C3", "C4")]
    reactions = [plate[w] for w in ("A1", "B1", "C1", "D1")]
    p20.transfer(18, mastermix, reactions, new_tip="once")
    p20.transfer(2, templates, reactions, new_tip="always")
    # column 12: empty wells for the lid heater test, 2 ul of water each against drying
    p20.transfer(2, nfw, plate.columns()[11][:3], new_tip="once")
