metadata = {"protocolName": "follows the liquid's level"}
requirements = {"robotType": "Flex", "apiLevel": "2.27"}


def run(ctx):
    trash = ctx.load_trash_bin("A3")
    tips = ctx.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
    plate = ctx.load_labware("nest_96_wellplate_2ml_deep", "D2")
    res = ctx.load_labware("nest_12_reservoir_15ml", "D3")
    p1000 = ctx.load_instrument("flex_1channel_1000", "left", tip_racks=[tips], liquid_presence_detection=True)
    dye = ctx.define_liquid("dye", "", "#ff0000")
    res.load_liquid(["A1", "A2"], 9000, dye)
    plate.load_empty(plate.wells())

    p1000.pick_up_tip()
    p1000.aspirate(100, res["A1"].meniscus(z=-2, target="end"))
    p1000.dispense(100, plate["A1"].meniscus(z=1, target="end"))
    p1000.drop_tip()
    p1000.pick_up_tip()
    p1000.aspirate(150, res["A1"].meniscus(z=-1, target="start"), end_location=res["A1"].meniscus(z=-1, target="end"), movement_delay=0.1)
    p1000.dispense(150, plate["A1"].bottom(1), end_location=plate["A1"].bottom(4))
    p1000.dynamic_mix(plate["A1"].bottom(1), plate["A1"].bottom(4), repetitions=2, volume=60)
    p1000.drop_tip()
    sticky = ctx.define_liquid_class("sticky", properties={}, base_liquid_class=ctx.get_liquid_class("glycerol_50"))
    p1000.transfer_with_liquid_class(sticky, 40, [res["A2"]] * 2, plate.columns()[1][:2], new_tip="always", trash_location=trash)
    timer = ctx.create_timer(5)
    p1000.transfer(30, res["A2"], plate["A4"])
    ctx.wait_for_tasks([timer])
