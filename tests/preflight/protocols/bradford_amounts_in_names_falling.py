# expect: bradford fail BRD-1
metadata = {"protocolName": "Bradford quick", "apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3)
    res = ctx.load_labware("nest_12_reservoir_15ml", 6)
    p = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    coomassie = res["A1"]
    s_2000, s_1000, s_500, s_250, s_0 = rack.wells()[:5]
    lysates = rack.wells()[6:9]
    p.pick_up_tip()
    for n, s in enumerate([s_2000, s_1000, s_500, s_250, s_0]):
        p.aspirate(20, s)
        p.dispense(20, plate.wells()[n])
    p.drop_tip()
    for n, s in enumerate(lysates):
        p.transfer(20, s, plate.wells()[8 + n])
    for w in plate.wells()[:5] + plate.wells()[8:11]:
        p.transfer(200, coomassie, w, mix_after=(3, 100))
