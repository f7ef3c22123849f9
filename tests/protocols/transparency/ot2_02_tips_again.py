metadata = {'apiLevel': '2.2', 'protocolName': 'returned tips, starting tip, reset'}


def run(ctx):
    rack = ctx.load_labware('opentrons_96_tiprack_300ul', 5)
    spare = ctx.load_labware('opentrons_96_tiprack_300ul', 6)
    plate = ctx.load_labware('corning_96_wellplate_360ul_flat', 2)
    water = ctx.load_labware('agilent_1_reservoir_290ml', 3).wells()[0]
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=[rack, spare])

    p300.starting_tip = rack['C12']
    for well in plate.columns()[0]:
        p300.pick_up_tip()
        p300.aspirate(75, water)
        p300.dispense(75, well)
        p300.return_tip()
    ctx.comment('return height %.2f' % p300.return_height)

    p300.reset_tipracks()
    p300.pick_up_tip(rack['C12'])
    p300.transfer(50, plate['A1'], plate['A2'], new_tip='never')
    p300.drop_tip(rack['C12'])
    p300.pick_up_tip(spare.wells_by_name()['H12'], presses=2, increment=0.5)
    p300.aspirate(60, plate['B1'])
    p300.drop_tip(spare['H12'].top(-20))
    p300.pick_up_tip(rack)
    p300.return_tip()
