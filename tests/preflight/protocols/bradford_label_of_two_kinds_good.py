# expect: bradford pass
"""Quick Start Bradford, lysates of six clones."""

metadata = {"apiLevel": "2.13"}

# BSA in rack A1-A6: 0, 0.125, 0.25, 0.5, 1 and 2 mg/ml


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1, "BSA + lysates")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2)
    reagent = ctx.load_labware("nest_1_reservoir_195ml", 3, "Coomassie reagent")["A1"]
    t20 = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    t300 = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    top, second = rack.rows()[0], rack.rows()[1]

    p20.pick_up_tip()
    for tube, well in zip(top, plate.columns()[0]):
        p20.aspirate(5, tube)
        p20.dispense(5, well)
    p20.drop_tip()
    lysates = second
    for tube, well in zip(lysates, plate.columns()[1]):
        p20.transfer(5, tube, well)
    for well in plate.columns()[0][:6] + plate.columns()[1][:6]:
        p300.transfer(245, reagent, well, new_tip="always", mix_after=(3, 150))
