from opentrons import protocol_api

metadata = {
    "protocolName": "SARS-CoV-2 N1 RT-qPCR, 16 swabs",
    "author": "Diagnostics",
}
requirements = {"robotType": "OT-2", "apiLevel": "2.16"}


class Recipe:
    mix = 15
    template = 5


def run(ctx: protocol_api.ProtocolContext):
    # ---- deck ----
    elution = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", "4", label="RNA eluates")
    pcr = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", "1", label="N1 plate")
    tubes = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", "2", label="Reagent block")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", "5")
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[tips])

    # ---- liquids ----
    n1_mix = ctx.define_liquid(name="N1 master mix", description="one-step RT-qPCR", display_color="#00FF00")
    h2o = ctx.define_liquid(name="Nuclease-free water", description="", display_color="#0000FF")
    plasmid = ctx.define_liquid(name="N1 plasmid positive control", description="", display_color="#FF0000")
    rna = ctx.define_liquid(name="Patient RNA", description="template", display_color="#FFFF00")
    tubes["A1"].load_liquid(n1_mix, 400)
    tubes["A2"].load_liquid(h2o, 500)
    tubes["A6"].load_liquid(plasmid, 100)
    patient_rna = elution.columns()[0] + elution.columns()[1]
    for well in patient_rna:
        well.load_liquid(rna, 40)

    patient_wells = pcr.columns()[0] + pcr.columns()[1]
    ntc, pos = pcr["A3"], pcr["B3"]

    # ---- master mix ----
    p20.pick_up_tip()
    for well in patient_wells + [ntc, pos]:
        p20.aspirate(Recipe.mix, tubes["A1"])
        p20.dispense(Recipe.mix, well)
    p20.drop_tip()

    # ---- NTC ----
    p20.transfer(2, tubes["A2"], ntc, mix_after=(2, 10))

    # ---- template ----
    p20.transfer(Recipe.template, patient_rna, patient_wells, new_tip="always", mix_after=(2, 10))
    p20.transfer(Recipe.template, tubes["A6"], pos, mix_after=(2, 10))
