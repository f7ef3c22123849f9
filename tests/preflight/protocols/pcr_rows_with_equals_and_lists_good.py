# expect: pcr pass PCR-4!
"""ChIP-qPCR at one promoter, triplicates in columns 1-3.

rows: A-F = IP1..5, input; G = empty; H = NTC.
"""

metadata = {"protocolName": "ChIP-qPCR", "apiLevel": "2.13"}


def run(ctx):
    chip = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    tubes = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, fill = tubes["A1"], tubes["B1"]
    dna = chip.wells()[:6]

    for row in [*plate.rows()[:6], plate.rows()[7]]:
        p20.transfer(15, master_mix, row[:3], new_tip="always")
    for tube, row in zip(dna, plate.rows()):
        p20.transfer(5, tube, row[:3])
    p20.transfer(5, fill, plate.rows()[7][:3])
