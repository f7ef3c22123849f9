# raises: LidStillOn
metadata = {'apiLevel': '2.14', 'protocolName': 'fails by itself half-way'}


class LidStillOn(Exception):
    pass


def check(well):
    if well.well_name == 'D1':
        raise LidStillOn('LidStillOn: take the lid off %s' % well)


def run(ctx):
    tips = ctx.load_labware('opentrons_96_tiprack_300ul', 4)
    plate = ctx.load_labware('corning_96_wellplate_360ul_flat', 1)
    water = ctx.load_labware('nest_1_reservoir_195ml', 2)['A1']
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=[tips])
    p300.pick_up_tip()
    for well in plate.columns()[0]:
        p300.aspirate(100, water)
        check(well)
        p300.dispense(100, well)
    p300.drop_tip()
