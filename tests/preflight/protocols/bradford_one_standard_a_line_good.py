# expect: bradford pass
"""Protein of the eluates (Bradford).

BSA rack:
    A1 BSA 2000 ug/ml
    A2 BSA 1000
    A3 BSA 500
    A4 BSA 250
    A5 buffer 0
"""

metadata = {"protocolName": "eluates", "apiLevel": "2.14"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "4", "BSA rack")
    eluates = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", "5", "eluates")
    assay = ctx.load_labware("corning_96_wellplate_360ul_flat", "1", "assay plate")
    bradford = ctx.load_labware("nest_12_reservoir_15ml", "6").wells()[0]
    p20 = ctx.load_instrument(
        "p20_single_gen2", "left", [ctx.load_labware("opentrons_96_filtertiprack_20ul", "7")]
    )
    m300 = ctx.load_instrument(
        "p300_multi_gen2", "right", [ctx.load_labware("opentrons_96_filtertiprack_200ul", "8")]
    )

    p20.pick_up_tip()
    for i in (4, 3, 2, 1, 0):
        p20.transfer(10, rack.rows()[0][i], assay.columns()[0][i], new_tip="never")
    p20.drop_tip()
    for i in range(8):
        p20.transfer(10, eluates.columns()[0][i], assay.columns()[1][i], new_tip="always")
    for i in range(2):
        m300.transfer(190, bradford, assay.columns()[i][0], new_tip="always", mix_after=(3, 80))
