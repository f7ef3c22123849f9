# expect: generic fail GEN-1
"""Equal volumes of the barcoded PCRs of one plate, one tube, before the bead bench."""

metadata = {"protocolName": "Pool the night's PCRs", "apiLevel": "2.13"}


def run(ctx):
    pcr = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "index PCR samples")
    rack = ctx.load_labware("opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap", 2)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    tube = rack["B3"]
    other = rack["B4"]
    p20.pick_up_tip()
    for well in pcr.wells()[:20]:
        p20.aspirate(12, well)
        p20.dispense(12, tube)
    for well in pcr.wells()[20:40]:
        p20.aspirate(12, well)
        p20.dispense(12, other)
    p20.drop_tip()
