"""Mycoplasma end-point PCR.

Twenty culture supernatants, a positive control and a no-template control, 25 uL each.
Master mix is put in first, into dry wells.
"""

metadata = {
    "protocolName": "Mycoplasma PCR set-up",
    "author": "Cell bank QC",
    "apiLevel": "2.14",
}

MASTER_MIX_UL = 20
TEMPLATE_UL = 5


def run(ctx):
    cold_block = ctx.load_module("temperature module gen2", 1)
    plate = cold_block.load_labware("opentrons_96_aluminumblock_biorad_wellplate_200ul", label="PCR plate")
    supernatants = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, label="Culture supernatants")
    reagent_rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5, label="Reagents")
    tips20 = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    tips200 = ctx.load_labware("opentrons_96_filtertiprack_200ul", 6)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[tips200])

    liquids = {
        "mm": ctx.define_liquid("Taq master mix", "with Myco primers", "#00aa00"),
        "water": ctx.define_liquid("PCR water", "nuclease free", "#99ccff"),
        "pos": ctx.define_liquid("Positive control", "M. orale DNA", "#cc0000"),
        "sample": ctx.define_liquid("Sample", "boiled supernatant", "#ffcc00"),
    }
    reagent_rack["A1"].load_liquid(liquids["mm"], 650)
    reagent_rack["A2"].load_liquid(liquids["water"], 200)
    reagent_rack["D6"].load_liquid(liquids["pos"], 50)
    for tube in supernatants.wells()[:20]:
        tube.load_liquid(liquids["sample"], 100)

    sample_wells = plate.wells()[:20]
    positive_well = plate["E3"]
    ntc_well = plate["H3"]

    cold_block.set_temperature(4)

    p300.distribute(
        MASTER_MIX_UL,
        reagent_rack["A1"],
        sample_wells + [positive_well, ntc_well],
        disposal_volume=20,
    )

    # negative before anything else is opened
    p20.transfer(TEMPLATE_UL, reagent_rack["A2"], ntc_well, mix_after=(3, 15))

    for tube, well in zip(supernatants.wells(), sample_wells):
        p20.transfer(TEMPLATE_UL, tube, well, mix_after=(3, 15), new_tip="always")

    p20.transfer(TEMPLATE_UL, reagent_rack["D6"], positive_well, mix_after=(3, 15))
    cold_block.deactivate()
