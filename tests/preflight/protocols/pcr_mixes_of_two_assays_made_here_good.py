"""Two assays of different reaction volumes, the mixes of which the run makes."""

metadata = {"protocolName": "qPCR, gene and reference", "apiLevel": "2.15"}
MIXES = {
    "gene": {"master_mix": "A1", "buffer": "B1", "enzyme": "C1", "column": 0, "ul": 16, "dna": 4},
    "reference": {"master_mix": "A2", "buffer": "B2", "enzyme": "C2", "column": 1, "ul": 8, "dna": 2},
}


def run(ctx):
    block = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 4)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    p20 = ctx.load_instrument(
        "p20_single_gen2", "left", tip_racks=[ctx.load_labware("opentrons_96_tiprack_20ul", 1)]
    )
    p300 = ctx.load_instrument(
        "p300_single_gen2", "right", tip_racks=[ctx.load_labware("opentrons_96_tiprack_300ul", 3)]
    )
    templates = tubes.rows()[0][:5]
    water = block["D6"]
    for assay in MIXES.values():
        master_mix = block[assay["master_mix"]]
        p300.transfer(8 * assay["ul"], block[assay["buffer"]], master_mix)
        p300.transfer(3 * assay["ul"], block[assay["enzyme"]], master_mix, mix_after=(5, 40))
        *reactions, ntc = plate.columns()[assay["column"]][:6]
        p20.transfer(assay["ul"], master_mix, [*reactions, ntc], new_tip="once")
        p20.transfer(assay["dna"], water, ntc, new_tip="always")
        p20.transfer(assay["dna"], templates, reactions, new_tip="always")
