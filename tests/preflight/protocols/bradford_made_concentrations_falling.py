# expect: bradford fail BRD-1
metadata = {"protocolName": "BCA", "apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3)
    res = ctx.load_labware("nest_12_reservoir_15ml", 6)
    p = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    wr = res["A1"]
    concs = [2000 / 2**i for i in range(7)] + [0]
    std_tubes = rack.wells()[:8]
    p.pick_up_tip()
    for tube, well in zip(std_tubes, plate.columns()[0]):
        p.aspirate(25, tube)
        p.dispense(25, well)
    p.drop_tip()
    unknowns = rack.wells()[8:12]
    for u, w in zip(unknowns, plate.columns()[1]):
        p.transfer(25, u, w)
    p.transfer(
        200, wr, plate.columns()[0] + plate.columns()[1][:4], new_tip="always", mix_after=(2, 100)
    )
