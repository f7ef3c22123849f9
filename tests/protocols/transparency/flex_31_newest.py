"""Names its tips, throws liquid away by liquid class."""
metadata = {"protocolName": "the newest level for the Flex on 10"}
requirements = {"robotType": "Flex", "apiLevel": "2.31"}


def run(ctx):
    chute = ctx.load_waste_chute()
    tips = ctx.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
    plate = ctx.load_labware("nest_96_wellplate_200ul_flat", "C2")
    res = ctx.load_labware("nest_12_reservoir_15ml", "C1")
    p1000 = ctx.load_instrument("flex_1channel_1000", "left", tip_racks=[tips])
    p1000.trash_container = chute
    water = ctx.get_liquid_class("water")

    p1000.transfer_with_liquid_class(
        water, 40, [res["A1"], res["A2"]], plate.columns()[0][:2], new_tip="always", tips=[tips["C3"], tips["D3"]],
    )
    p1000.transfer_with_liquid_class(water, 30, plate.columns()[0][:2], chute, new_tip="always")
    p1000.pick_up_tip(tips["H12"])
    p1000.aspirate(50, res["A3"])
    ctx.delay(seconds=1)
    p1000.dispense(50, plate["H1"], push_out=2)
    ctx.comment(str(p1000.current_tip_source_well()))
    p1000.drop_tip()
    table = ctx.create_csv("wells", title_row=["well", "volume"])
    ctx.comment(type(table).__name__)
