# expect: pcr fail PCR-4
metadata = {"apiLevel": "2.13"}
SAMPLES = 8


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    rack = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    dna = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 4, "gDNA extracts")
    pcr = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 5, "PCR plate")
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    mm = rack["A1"]
    ntc = rack["B1"]
    p20.transfer(15, mm, pcr.wells()[:SAMPLES], new_tip="once")
    p20.transfer(5, ntc, pcr.wells()[SAMPLES - 1])
    for i in range(SAMPLES):
        p20.transfer(5, dna.wells()[i], pcr.wells()[i])
