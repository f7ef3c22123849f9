# expect: generic fail GEN-3
"""Make a ligation mix in one tube and share it out."""

metadata = {"apiLevel": "2.13", "protocolName": "Ligation"}
N = 16


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    strip = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2)
    t20 = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    t300 = ctx.load_labware("opentrons_96_filtertiprack_200ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    buffer, water, ligase = rack["A1"], rack["A2"], rack["A3"]
    ligation_mix = rack["B1"]

    volume = {"buffer": 2, "water": 7, "ligase": 1}
    p300.transfer(volume["water"] * N * 1.1, water, ligation_mix)
    p300.transfer(volume["buffer"] * N * 1.1, buffer, ligation_mix)
    p20.transfer(volume["ligase"] * N * 1.1, ligase, ligation_mix, mix_after=(3, 20))
    p20.pick_up_tip()
    for well in strip.wells()[:N]:
        p20.aspirate(14, ligation_mix)
        p20.dispense(14, well)
    p20.drop_tip()
