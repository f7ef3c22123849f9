metadata = {"protocolName": "distribute and consolidate with liquid classes"}
requirements = {"robotType": "Flex", "apiLevel": "2.24"}


def run(ctx):
    ctx.load_waste_chute()
    tips50 = ctx.load_labware("opentrons_flex_96_tiprack_50ul", "B1")
    tips1000 = ctx.load_labware("opentrons_flex_96_tiprack_1000ul", "B2")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", "D1")
    pcr = ctx.load_labware("opentrons_96_wellplate_200ul_pcr_full_skirt", "C1")
    res = ctx.load_labware("nest_12_reservoir_15ml", "D2")
    p1000 = ctx.load_instrument("flex_1channel_1000", "left", tip_racks=[tips1000])
    m50 = ctx.load_instrument("flex_8channel_50", "right", tip_racks=[tips50])
    water = ctx.get_liquid_class("water")
    ethanol = ctx.get_liquid_class("ethanol_80")

    p1000.distribute_with_liquid_class(
        liquid_class=ethanol, volume=90, source=res["A1"], dest=plate.columns()[0], new_tip="once",
    )
    p1000.consolidate_with_liquid_class(
        liquid_class=water, volume=80, source=plate.columns()[0][:5], dest=res["A12"], new_tip="once",
    )
    m50.transfer_with_liquid_class(water, 20, [res["A2"], res["A4"]], pcr.columns()[:2], new_tip="always")
    m50.distribute_with_liquid_class(water, 10, res["A3"], pcr.columns()[3:6], new_tip="once", return_tip=True)
