from opentrons import types

metadata = {'apiLevel': '2.4', 'protocolName': 'speeds, clearances, moves'}


def run(ctx):
    ctx.home()
    ctx.max_speeds['X'] = 300
    ctx.max_speeds.update({'Y': 250})
    tips = ctx.load_labware('opentrons_96_tiprack_300ul', 1)
    plate = ctx.load_labware('corning_96_wellplate_360ul_flat', 2)
    m300 = ctx.load_instrument('p300_multi', 'left', tip_racks=[tips])
    m300.default_speed = 200
    m300.well_bottom_clearance.aspirate = 2
    m300.well_bottom_clearance.dispense = 7
    m300.flow_rate.aspirate = 80
    m300.speed.aspirate = 20

    m300.pick_up_tip()
    m300.move_to(plate['A1'].top(10), speed=50)
    m300.move_to(plate['A1'].bottom(5), force_direct=True)
    m300.aspirate(100)
    m300.move_to(plate['A2'].top(), minimum_z_height=120)
    m300.dispense(50)
    m300.dispense(50, types.Location(plate['A3'].center().point, plate['A3']))
    m300.aspirate(40, plate['A2'].center())
    m300.aspirate(40, plate['A2'].bottom().move(types.Point(0, 1, 1)))
    m300.dispense(80, types.Location(plate['A4'].top().point, None))
    m300.mix(2, 40, plate['A1'], rate=1.5)
    m300.drop_tip()
    del ctx.max_speeds['X']
    ctx.max_speeds['Y'] = None
    ctx.comment(str(ctx.location_cache))
