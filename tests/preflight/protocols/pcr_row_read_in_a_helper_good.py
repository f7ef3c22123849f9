# expect: pcr pass
metadata = {"protocolName": "qPCR of swabs", "apiLevel": "2.14"}

PLAN = [
    {"id": "swab_07", "vial": "B1", "wells": ["B1", "C1"]},
    {"id": "swab_09", "vial": "B2", "wells": ["B2", "C2"]},
    {"id": "swab_12", "vial": "B3", "wells": ["B3", "C3"]},
    {"id": "transport_blank", "vial": "D5", "wells": ["B8", "C8"]},
]


def run(ctx):
    vials = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5, "eluates")
    strips = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 6, "qPCR strips")
    mix = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 9, "master mix")["A1"]
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 2)
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[tips])

    def fill(entry):
        for spot in entry["wells"]:
            p20.transfer(15, mix, strips[spot], new_tip="always")
            p20.transfer(5, vials[entry["vial"]], strips[spot], new_tip="always")

    for entry in PLAN:
        fill(entry)
