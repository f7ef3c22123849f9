# raises: list index out of range
metadata = {'apiLevel': '2.12'}


def run(ctx):
    tips = ctx.load_labware('opentrons_96_tiprack_300ul', 4)
    plate = ctx.load_labware('corning_6_wellplate_16.8ml_flat', 1)
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=[tips])
    try:
        p300.aspirate(50, plate['A1'])
    except Exception as error:  # no tip yet
        ctx.comment('as expected: %s' % type(error).__name__)
    p300.pick_up_tip()
    try:
        p300.aspirate(500, plate['A1'])
    except Exception as error:
        ctx.comment('too much: %s' % type(error).__name__)
        if p300.current_volume:
            p300.dispense(p300.current_volume, plate['A1'])
    for n in range(7):
        p300.transfer(50, plate['A1'], plate.wells()[n + 1], new_tip='never')
    p300.drop_tip()
