metadata = {"apiLevel": "2.13", "protocolName": "two genotyping PCR assays on eight lysates"}
NTC = ("A2", "B2")


def run(ctx):
    lysates = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "DNA templates")
    plates = {
        "cre": ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "Cre assay"),
        "flp": ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, "Flp assay"),
    }
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 6)
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (4, 7)]
    s20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=tips)
    master_mixes = {"cre": tubes["A1"], "flp": tubes["A2"]}
    water = tubes["A6"]

    for assay, dest in plates.items():
        reactions = [*dest.columns()[0], *(dest[name] for name in NTC)]
        s20.distribute(8, master_mixes[assay], reactions, disposal_volume=0)
    for assay, dest in plates.items():
        for name in NTC:
            s20.transfer(
                2, water if assay == "cre" else lysates["A1"], dest[name], new_tip="always"
            )
        for source, target in zip(lysates.columns()[0], dest.columns()[0]):
            s20.transfer(2, source, target, new_tip="always")
