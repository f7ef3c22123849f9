metadata = {"protocolName": "steps in groups, pictures"}
requirements = {"robotType": "Flex", "apiLevel": "2.29"}


def run(ctx):
    trash = ctx.load_trash_bin("A3")
    tips = ctx.load_labware("opentrons_flex_96_filtertiprack_200ul", "B2")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", "D2")
    res = ctx.load_labware("nest_12_reservoir_15ml", "D3")
    m1000 = ctx.load_instrument("flex_8channel_1000", "left", tip_racks=[tips])
    water = ctx.get_liquid_class("water")

    with ctx.group_steps("first half", description="buffer"):
        m1000.transfer(50, res["A1"], plate.rows()[0][:3], new_tip="once")
        ctx.capture_image(filename="after the buffer")
    group = ctx.create_and_start_step_group("second half")
    m1000.transfer_with_liquid_class(
        water, 30, [res["A2"]] * 2, plate.columns()[:2], new_tip="once", trash_location=trash, keep_last_tip=True,
    )
    m1000.mix(2, 40, plate["A1"])
    group.end_group()
    m1000.drop_tip()
    m1000.transfer_with_liquid_class(
        water, 25, res["A3"], [plate.columns()[4]], new_tip="always", tip_racks=[tips], trash_location=trash,
    )
