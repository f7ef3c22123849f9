# expect: pcr fail PCR-4
metadata = {"protocolName": "Salmonella invA", "apiLevel": "2.13"}
SPOTS = {"mix": "A6", "water": "B6", "dna": "C6", "samples": ["A1", "A2"], "ntc": ["H11", "H12"]}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    tubes = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    for name in SPOTS["samples"] + SPOTS["ntc"]:
        p20.transfer(18, tubes[SPOTS["mix"]], plate[name], new_tip="always")
    for name in SPOTS["samples"]:
        p20.transfer(2, tubes[SPOTS["dna"]], plate[name], new_tip="always")
    for name in SPOTS["ntc"]:
        p20.transfer(2, tubes[SPOTS["dna"]], plate[name], new_tip="always")
