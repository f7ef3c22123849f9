# expect: pcr fail PCR-4
metadata = {"protocolName": "Bat cytb PCR", "apiLevel": "2.13"}
WELLS = {"bat gDNA": ["A1", "A2", "A3"], "no gDNA": ["B1", "B2"]}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    tubes = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, water, gdna = tubes["A1"], tubes["B1"], tubes["C1"]
    for names in WELLS.values():
        for name in names:
            p20.transfer(18, master_mix, plate[name], new_tip="always")
    for name in WELLS["bat gDNA"]:
        p20.transfer(2, gdna, plate[name], new_tip="always")
    for name in WELLS["no gDNA"]:
        p20.transfer(2, gdna, plate[name], new_tip="always")
