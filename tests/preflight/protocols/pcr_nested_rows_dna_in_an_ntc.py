# expect: pcr fail PCR-4
metadata = {"protocolName": "Malaria speciation", "apiLevel": "2.13"}
REACTIONS = {
    "A1": ("patient", "A1"),
    "A2": ("patient", "A2"),
    "A3": ("patient", "A3"),
    "A4": ("patient", "A4"),
    "B1": ("ntc", "D6"),
    "B2": ("ntc", "A4"),
}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    dna = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "DNA")
    mix = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 3, "PCR mix")["A1"]
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    for well, (kind, tube) in REACTIONS.items():
        p20.transfer(15, mix, plate[well], new_tip="always")
        p20.transfer(5, dna[tube], plate[well], new_tip="always")
