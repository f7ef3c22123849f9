# expect: pcr pass
from opentrons import protocol_api

metadata = {"protocolName": "PCR, templates with inhibitor", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5, 6)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    """PCR inhibition test: one DNA with three spikes; the control gets water as the spike, 2 ul each."""
    mastermix, water, dna = tubes["A1"], tubes["A2"], tubes["A3"]
    humic, hemin, tannic = tubes["B1"], tubes["B2"], tubes["B3"]
    wells = plate.columns()[0][:4]
    p20.transfer(14, mastermix, wells, new_tip="once")
    p20.pick_up_tip()
    p20.transfer(2, humic, wells[0], new_tip="never")
    p20.transfer(2, hemin, wells[1], new_tip="never")
    p20.transfer(2, tannic, wells[2], new_tip="never")
    p20.transfer(2, water, wells[3], new_tip="never")
    p20.drop_tip()
    p20.transfer(4, dna, wells, new_tip="always")
