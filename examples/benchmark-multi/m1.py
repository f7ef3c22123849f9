"""Probe qPCR for a transgene in sixteen plasma cfDNA preps."""
from opentrons import protocol_api

metadata = {"protocolName": "Transgene copy number", "author": "Bioanalytics", "apiLevel": "2.15"}


def run(ctx: protocol_api.ProtocolContext):
    preps = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1, label="cfDNA preps")
    reagents = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2, label="qPCR reagents")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, label="qPCR plate")
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    mix = reagents["A1"]
    water = reagents["A2"]
    positive_control = reagents["A3"]
    mix.load_liquid(ctx.define_liquid("Probe master mix", "primers and probe in it", "#00bb55"), 600)
    water.load_liquid(ctx.define_liquid("PCR-grade water", "", "#77bbff"), 500)
    positive_control.load_liquid(ctx.define_liquid("Positive control plasmid", "1e4 copies", "#dd2222"), 80)
    template = ctx.define_liquid("cfDNA template", "", "#ddbb33")
    for tube in preps.wells()[:16]:
        tube.load_liquid(template, 60)

    batch_one = plate.columns()[0]
    batch_two = plate.columns()[1]
    pos_well, ntc_well = plate["A3"], plate["B3"]

    # mix: 15 uL per reaction
    p20.transfer(15, mix, batch_one)
    p20.transfer(12.5, mix, batch_two)
    p20.transfer(15, mix, [pos_well, ntc_well])

    # controls
    p20.transfer(5, reagents["A3"], pos_well, mix_after=(3, 10))
    p20.transfer(5, reagents["A3"], ntc_well, mix_after=(3, 10))

    # preps 1-8
    p20.transfer(5, preps.wells()[:8], batch_one, mix_after=(3, 10), new_tip="always")

    # preps 9-16
    p20.transfer(5, preps.wells()[8:16], batch_two, mix_after=(3, 10), new_tip="once")
