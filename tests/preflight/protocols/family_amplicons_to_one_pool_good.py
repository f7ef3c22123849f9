# expect: generic pass
metadata = {"protocolName": "qPCR amplicons to one sequencing pool", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "amplicons")
    other = ctx.load_labware("nest_96_wellplate_2ml_deep", 2, "x")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    res = ctx.load_labware("nest_12_reservoir_15ml", 5)
    t20 = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 7)]
    t300 = [ctx.load_labware("opentrons_96_filtertiprack_200ul", s) for s in (6, 8, 9)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=t20)
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=t300)

    p20.consolidate(5, plate.wells()[:24], rack["A1"], new_tip="always")
