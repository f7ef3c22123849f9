from opentrons import protocol_api

requirements = {'robotType': 'OT-2', 'apiLevel': '2.16'}
metadata = {'protocolName': 'plates come and go'}


def run(ctx: protocol_api.ProtocolContext):
    tips = [ctx.load_labware('opentrons_96_tiprack_300ul', s) for s in ('4', '5')]
    res = ctx.load_labware('nest_12_reservoir_15ml', '2')
    first = ctx.load_labware('corning_96_wellplate_360ul_flat', '1', 'plate 1')
    second = ctx.load_labware('corning_96_wellplate_360ul_flat', '3', 'plate 2')
    m300 = ctx.load_instrument('p300_multi_gen2', 'left', tip_racks=tips)
    trash = m300.trash_container

    m300.pick_up_tip()
    for target in first.rows()[0][:3] + second.rows()[0][:3]:
        m300.aspirate(120, res['A1'])
        m300.dispense(100, target)
        m300.dispense(20, trash)
    m300.blow_out(trash)
    m300.drop_tip(trash)

    ctx.move_labware(first, protocol_api.OFF_DECK)
    ctx.move_labware(second, '1')
    third = ctx.load_labware('corning_96_wellplate_360ul_flat', '3', 'plate 3')
    m300.transfer(80, second.rows()[0][:3], third.rows()[0][:3], new_tip='always')
    m300.prepare_to_aspirate() if m300.has_tip else None
    ctx.pause('shake plate 3')
    m300.consolidate(30, third.rows()[0][:3], res['A12'], blow_out=True, blowout_location='destination well')
    ctx.move_labware(first, 6)
    m300.pick_up_tip()
    m300.aspirate(50, first['A1']).dispense(50, trash)
    m300.drop_tip()
