from opentrons import protocol_api

metadata = {"protocolName": "Genotyping PCR, ear clips", "author": "Animal facility"}
requirements = {"robotType": "OT-2", "apiLevel": "2.20"}


def add_parameters(parameters):
    parameters.add_int(
        variable_name="n_clips", display_name="Ear clips", default=14, minimum=1, maximum=22,
    )
    parameters.add_float(
        variable_name="mix_ul", display_name="Master mix per reaction", default=18.0, minimum=10.0, maximum=24.0,
        unit="µL",
    )


def run(ctx: protocol_api.ProtocolContext):
    n = ctx.params.n_clips
    mix_ul = ctx.params.mix_ul

    lysate_plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, label="Ear clip lysates")
    pcr_plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, label="Genotyping PCR")
    block = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 1, label="Cold reagents")
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (4, 5)]
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=tips)

    mm = ctx.define_liquid("GoTaq master mix", "allele primers included", "#00cc66")
    water = ctx.define_liquid("water", "molecular biology grade", "#66ccff")
    het = ctx.define_liquid("Heterozygous control DNA", "positive control", "#ff3333")
    lysate = ctx.define_liquid("Lysate", "crude template", "#cc9900")
    block["A1"].load_liquid(mm, 500)
    block["B1"].load_liquid(water, 500)
    block["C1"].load_liquid(het, 60)
    for w in lysate_plate.wells()[:n]:
        w.load_liquid(lysate, 50)

    clips = lysate_plate.wells()[:n]
    reactions = pcr_plate.wells()[: n + 2]
    positive, ntc = reactions[n], reactions[n + 1]

    # master mix to n samples and the controls
    p20.pick_up_tip()
    for i in range(n + 1):
        p20.aspirate(mix_ul, block["A1"])
        p20.dispense(mix_ul, reactions[i])
    p20.drop_tip()

    # template
    for clip, reaction in zip(clips, reactions):
        p20.transfer(2, clip, reaction, mix_after=(3, 10))
    p20.transfer(2, block["C1"], positive, mix_after=(3, 10))
    p20.transfer(2, block["B1"], ntc)
