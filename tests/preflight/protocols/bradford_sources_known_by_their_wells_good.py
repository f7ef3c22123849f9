# expect: bradford pass
"""Bradford assay of urine and plasma.

assay plate: A1-F1 standards, A2-H2 samples
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    strips = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3, "assay plate")
    dye = ctx.load_labware("nest_1_reservoir_195ml", 4)["A1"]
    t20 = ctx.load_labware("opentrons_96_filtertiprack_20ul", 5)
    t300 = ctx.load_labware("opentrons_96_filtertiprack_200ul", 6)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[t300])

    for tube, well in zip(rack.rows()[0], plate.columns()[0]):
        p20.transfer(5, tube, well, new_tip="always")
    for tube, well in zip(strips.columns()[0], plate.columns()[1]):
        p20.transfer(5, tube, well, new_tip="always")
    for column in plate.columns()[:2]:
        m300.transfer(195, dye, column[0], new_tip="always", mix_after=(3, 100))
