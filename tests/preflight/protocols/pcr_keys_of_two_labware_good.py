# expect: pcr pass
metadata = {"protocolName": "Salmonella invA", "apiLevel": "2.13"}
PLACES = {"mix": "A1", "water": "B1", "dna": ["A1", "A2", "A3"], "ntc": ["B1", "B2"]}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    tubes = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    extracts = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    for name in PLACES["dna"] + PLACES["ntc"]:
        p20.transfer(18, tubes[PLACES["mix"]], plate[name], new_tip="always")
    for name in PLACES["dna"]:
        p20.transfer(2, extracts[name], plate[name], new_tip="always")
    for name in PLACES["ntc"]:
        p20.transfer(2, tubes[PLACES["water"]], plate[name], new_tip="always")
