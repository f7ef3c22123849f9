metadata = {"apiLevel": "2.13", "protocolName": "Bradford, Fraktionen"}

# Platte: Sp. 1 Standards, Sp. 2 Fraktionen 1-8, Sp. 3 Fraktionen 9-16


def run(ctx):
    platte = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "Assay")
    vorlage = ctx.load_labware(
        "nest_96_wellplate_100ul_pcr_full_skirt", 1, "BSA (Sp. 1), Fraktionen (Sp. 2, 3)"
    )
    wanne = ctx.load_labware("nest_12_reservoir_15ml", 3, "Reagenz")
    s20 = ctx.load_labware("opentrons_96_tiprack_20ul", 4)
    s300 = ctx.load_labware("opentrons_96_tiprack_300ul", 5)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[s20])
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[s300])
    farbstoff = wanne["A1"]
    for n in range(3):
        m20.transfer(5, vorlage.columns()[n], platte.columns()[n])
    for n in range(3):
        m300.pick_up_tip()
        m300.aspirate(195, farbstoff)
        m300.dispense(195, platte.columns()[n][0].top())
        m300.mix(3, 120, platte.columns()[n][0])
        m300.drop_tip()
