# expect: pcr pass
"""qPCR of seven extracts."""

metadata = {"apiLevel": "2.13", "protocolName": "qPCR"}


def run(ctx):
    p20 = ctx.load_instrument(
        "p20_single_gen2",
        "right",
        tip_racks=[ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (7, 8)],
    )
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    rna = ctx.load_labware("nest_96_wellplate_2ml_deep", 2, "RNA extracts")
    cold = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 3)
    master_mix, water = cold["A1"], cold["D6"]
    wells = plate.wells()[:8]  # 7 extracts, then the NTC
    p20.distribute(15, master_mix, wells)
    for template, well in zip(rna.wells()[:7], wells):
        p20.transfer(5, template, well)
    p20.transfer(5, water, plate["H1"])
