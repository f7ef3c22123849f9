metadata = {'apiLevel': '2.14', 'protocolName': 'PCR on deck'}


def run(ctx):
    tc = ctx.load_module('thermocycler')
    plate = tc.load_labware('nest_96_wellplate_100ul_pcr_full_skirt')
    strips = ctx.load_labware('opentrons_96_aluminumblock_generic_pcr_strip_200ul', 4)
    racks = [ctx.load_labware('opentrons_96_filtertiprack_20ul', s) for s in (1, 2)]
    m20 = ctx.load_instrument('p20_multi_gen2', 'right', tip_racks=racks)
    tc.open_lid()
    tc.set_block_temperature(6)
    for i, column in enumerate(plate.columns()[:4]):
        m20.pick_up_tip()
        m20.aspirate(15, strips['A1'], rate=0.7)
        m20.touch_tip(radius=0.9, v_offset=-2, speed=20.0)
        m20.dispense(15, column[0], rate=2.0)
        m20.blow_out(column[0].top(-4))
        m20.drop_tip()
        m20.pick_up_tip()
        m20.aspirate(5, strips.columns()[i + 1][0])
        m20.dispense(5, column[0])
        m20.mix(3, 10)
        m20.drop_tip()
    tc.set_lid_temperature(100)
    tc.close_lid()
    tc.set_block_temperature(95, hold_time_minutes=2, block_max_volume=20)
    tc.execute_profile([{'temperature': 95, 'hold_time_seconds': 5}, {'temperature': 55, 'hold_time_seconds': 10}], 3)
    tc.open_lid()
    tc.deactivate()
