# expect: generic pass
metadata = {"protocolName": "IL-6 ELISA", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "ELISA plate")
    other = ctx.load_labware("nest_96_wellplate_2ml_deep", 2, "samples")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    res = ctx.load_labware("nest_12_reservoir_15ml", 5)
    t20 = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 7)]
    t300 = [ctx.load_labware("opentrons_96_filtertiprack_200ul", s) for s in (6, 8, 9)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=t20)
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=t300)

    stds = rack.rows()[0]
    blank = plate["A12"]
    tmb_reagent = res["A2"]
    std_wells = plate.rows()[0][:6]
    p20.transfer(10, stds, std_wells, new_tip="always")
    p20.transfer(10, res["A1"], blank)
    for w in [*std_wells, blank]:
        p300.transfer(50, tmb_reagent, w)
