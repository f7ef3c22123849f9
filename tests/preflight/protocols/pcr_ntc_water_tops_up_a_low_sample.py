# expect: pcr pass
metadata = {"apiLevel": "2.13"}
SAMPLES = 7


def run(ctx):
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (1, 3)]
    rack = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    dna = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 4, "gDNA extracts")
    pcr = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 5, "PCR plate")
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    mm = rack["A1"]
    ntc = rack["B1"]
    p20.transfer(15, mm, pcr.wells()[: SAMPLES + 1], new_tip="once")
    p20.transfer(5, ntc, pcr.wells()[SAMPLES])
    p20.transfer(2, ntc, pcr.wells()[3])  # the fourth extract is short: 3 uL, made up to 5
    for i in range(SAMPLES):
        p20.transfer(3 if i == 3 else 5, dna.wells()[i], pcr.wells()[i])
