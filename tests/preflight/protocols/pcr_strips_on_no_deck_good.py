# expect: pcr pass PCR-4!
"""Nosema in bees. qPCR plate A1-H1 bees, H2 NTC.

Thawed beforehand: strip 1: NTC of last week, strip 2: master mix.
"""

metadata = {"protocolName": "Nosema qPCR", "apiLevel": "2.13"}


def run(ctx):
    bees = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "bee DNA")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, "qPCR plate")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    mastermix, water = tubes["A1"], tubes["A2"]
    wells = plate.columns()[0]

    p20.transfer(2, water, plate["H2"])
    p20.transfer(2, bees.columns()[0], wells, new_tip="always")
    p20.transfer(18, mastermix, [*wells, plate["H2"]], new_tip="always", mix_after=(2, 10))
