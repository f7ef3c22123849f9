# expect: pcr pass PCR-4!
"""Xylella in olive. c1 A-H = leaf extracts, c2 A-B = leaf extracts, c2 H = NTC"""

metadata = {"protocolName": "Xylella qPCR", "apiLevel": "2.13"}


def run(ctx):
    leaves = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "olive leaf DNA")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, "qPCR")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, fill = tubes["A1"], tubes["A2"]
    trees = plate.wells()[:10]

    p20.transfer(18, master_mix, [*trees, plate["H2"]], new_tip="always")
    p20.transfer(2, leaves.wells()[:10], trees, new_tip="always")
    p20.transfer(2, fill, plate["H2"])
