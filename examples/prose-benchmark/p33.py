# ChIP-qPCR, 12 plates a week. Layout of one plate: IP eluates in A1-A8 and B1-B8, inputs in
# H1-H11, water (NTC) in H12. The mix is ready-made and stands in tube A1 of the block.

metadata = {"protocolName": "ChIP-qPCR", "apiLevel": "2.7"}

IP = [f"{row}{number}" for row in "AB" for number in range(1, 9)]
INPUT = [f"H{number}" for number in range(1, 12)]


def run(ctx):
    dna = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "ChIP DNA")
    pcr = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "reactions")
    block = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 3)
    t20 = [ctx.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (4, 5)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=t20)
    master_mix, water = block["A1"], block["D6"]

    for name in [*IP, *INPUT, "H12"]:
        p20.transfer(18, master_mix, pcr[name], new_tip="always")
    p20.transfer(2, water, pcr["H12"])
    for name in IP + INPUT:
        p20.transfer(2, dna[name], pcr[name], new_tip="always")
