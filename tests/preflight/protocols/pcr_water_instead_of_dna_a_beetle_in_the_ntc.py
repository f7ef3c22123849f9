# expect: pcr warn PCR-4
"""Barcode PCR of beetles.

Reactions: A1-H2 beetles, H3 no-template control (water instead of DNA).
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    reactions = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    beetles = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "beetle extracts")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    used = [*reactions.wells()[:16], reactions["H3"]]

    p20.distribute(18, tubes["A1"], used)  # master mix
    for well in reactions.wells()[:16]:
        p20.transfer(2, beetles[well.well_name], well)
    p20.transfer(2, beetles["H2"], reactions["H3"])
