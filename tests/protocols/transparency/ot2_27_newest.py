metadata = {"protocolName": "the newest level for the OT-2"}
requirements = {"robotType": "OT-2", "apiLevel": "2.27"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", "10")
    block = ctx.load_labware("opentrons_96_aluminumblock_nest_wellplate_100ul", "1")
    plate = ctx.load_labware("biorad_384_wellplate_50ul", "2")
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[tips])

    p20.pick_up_tip()
    ctx.comment(f"tip from {p20.current_tip_source_well()}")
    for n, well in enumerate(plate.rows()[0][:6]):
        p20.aspirate(5 + n, block["A1"])
        p20.dispense(5 + n, well)
    p20.dynamic_mix(aspirate_start_location=plate["A1"].bottom(1), dispense_start_location=plate["A1"].bottom(2), repetitions=2, volume=3)
    p20.return_tip()
    p20.transfer([3, 4, 5], block.columns()[1][:3], plate.columns()[23][:3], new_tip="always", mix_after=(1, 3))
    ctx.wait_for_tasks([ctx.create_timer(seconds=2)])
    ctx.delay(seconds=1)
