metadata = {"protocolName": "transfer with liquid classes"}
requirements = {"robotType": "Flex", "apiLevel": "2.24"}


def run(ctx):
    trash = ctx.load_trash_bin("A3")
    tips = ctx.load_labware("opentrons_flex_96_tiprack_200ul", "B1")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", "D2")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", "D1")
    p1000 = ctx.load_instrument("flex_1channel_1000", "left", tip_racks=[tips])
    water = ctx.get_liquid_class("water")
    glycerol = ctx.get_liquid_class("glycerol_50")

    p1000.transfer_with_liquid_class(
        liquid_class=water, volume=70, source=tubes.wells()[:4], dest=plate.columns()[0][:4],
        new_tip="always", trash_location=trash,
    )
    p1000.transfer_with_liquid_class(glycerol, 250, tubes["A6"], plate["H12"], new_tip="once", trash_location=trash)
    p1000.pick_up_tip()
    p1000.transfer_with_liquid_class(water, 30, [tubes["B2"], tubes["C2"]], plate.rows()[4][:2], new_tip="never")
    p1000.drop_tip()
    p1000.transfer_with_liquid_class(water, 25, tubes.wells()[:2], plate.rows()[5][:2], new_tip="per source", return_tip=True)
    p1000.transfer(40, tubes["D2"], plate["G7"])
