metadata = {'protocolName': 'Lysis buffer plating', 'apiLevel': '2.13'}


def run(ctx):
    res = ctx.load_labware('nest_12_reservoir_15ml', '2')
    plate = ctx.load_labware('corning_96_wellplate_360ul_flat', '6', 'sample plate')
    rack = ctx.load_labware('opentrons_96_tiprack_300ul', '4')
    m300 = ctx.load_instrument('p300_multi_gen2', 'left', tip_racks=[rack])
    lysis_buffer = res['A3']

    m300.pick_up_tip()
    for well in plate.rows()[0][:6]:
        m300.aspirate(50, lysis_buffer)
        m300.dispense(50, well.top())
        m300.move_to(well.top())
        m300.touch_tip(v_offset=1)
    m300.drop_tip()
