metadata = {'apiLevel': '2.14', 'protocolName': 'Plate 1 to plate 2', 'author': 'core'}


def run(ctx):
    tc = ctx.load_module('thermocycler')
    p2 = tc.load_labware('nest_96_wellplate_100ul_pcr_full_skirt')
    p1 = ctx.load_labware('nest_96_wellplate_100ul_pcr_full_skirt', '4')
    strip = ctx.load_labware('opentrons_96_aluminumblock_generic_pcr_strip_200ul', '5')
    tr = [ctx.load_labware('opentrons_96_filtertiprack_20ul', s) for s in ('1', '2')]
    m20 = ctx.load_instrument('p20_multi_gen2', 'right', tip_racks=tr)
    tc.open_lid()
    m20.transfer(15, strip['A1'], p2.rows()[0][:8], new_tip='once')
    for i in range(8):
        m20.pick_up_tip()
        m20.aspirate(5, p1.rows()[0][i])
        m20.dispense(5, p2.rows()[0][i])
        m20.mix(2, 10)
        m20.drop_tip()
    tc.close_lid()
    tc.set_lid_temperature(105)
    tc.execute_profile(steps=[{'temperature': 98, 'hold_time_seconds': 10}, {'temperature': 65, 'hold_time_seconds': 75}],
                       repetitions=12, block_max_volume=20)
    tc.set_block_temperature(4)
    tc.open_lid()
