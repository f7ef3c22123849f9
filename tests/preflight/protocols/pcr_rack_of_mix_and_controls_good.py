# expect: pcr pass PCR-4!
"""Ranavirus in newts: column 1 newts, A2 virus DNA, B2 NTC on the qPCR plate."""

metadata = {"protocolName": "Ranavirus qPCR", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 1, "MM / ctrl")
    newts = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "newt DNA")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, "qPCR plate")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    one, two, three = rack.rows()[0][:3]
    wells = plate.wells()[:10]

    p20.transfer(15, one, wells, new_tip="always")
    p20.transfer(5, newts.columns()[0], wells[:8], new_tip="always")
    p20.pick_up_tip()
    p20.transfer(5, three, wells[9], new_tip="never")
    p20.transfer(5, two, wells[8], new_tip="never")
    p20.drop_tip()
