# expect: bradford pass
"""Bradford of chloroplast fractions.

strips: col 1 standards, go onto plate col 2
        col 2 fractions
"""

metadata = {"protocolName": "Bradford, chloroplasts", "apiLevel": "2.13"}


def run(ctx):
    strips = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "strips")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "plate")
    dye = ctx.load_labware("nest_1_reservoir_195ml", 3, "Bradford reagent")["A1"]
    small = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    large = ctx.load_labware("opentrons_96_tiprack_300ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[large])

    p20.transfer(5, strips.columns()[0], plate.columns()[1], new_tip="always")
    p20.transfer(5, strips.columns()[1], plate.columns()[2], new_tip="always")
    for name in ("A2", "A3"):
        m300.transfer(250, dye, plate[name], mix_after=(3, 150), new_tip="always")
