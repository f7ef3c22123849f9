import itertools

metadata = {'apiLevel': '2.14', 'protocolName': 'liquids, generators, bound methods'}


def chunks(wells, size):
    wells = iter(wells)
    while batch := list(itertools.islice(wells, size)):
        yield batch


def run(ctx):
    tips = ctx.load_labware('opentrons_96_tiprack_300ul', 4)
    plate = ctx.load_labware('corning_96_wellplate_360ul_flat', 1, label='dye plate')
    trough = ctx.load_labware('nest_12_reservoir_15ml', 2)
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=[tips])
    red = ctx.define_liquid('red', 'food dye', '#ff0000')
    yellow = ctx.define_liquid('yellow', 'food dye', '#ffee00')
    trough['A1'].load_liquid(red, 9000)
    trough['A2'].load_liquid(liquid=yellow, volume=9000)

    do = {
        'take': p300.aspirate,
        'give': p300.dispense,
        'tip': p300.pick_up_tip,
        'bin': p300.drop_tip,
        'puff': p300.blow_out,
        'gap': p300.air_gap,
    }
    script = ['tip', ('take', 150), ('gap', 20), ('give', 20), 'each', 'puff', 'bin']

    for source, batch in zip(itertools.cycle([trough['A1'], trough['A2']]), chunks(plate.wells()[:12], 3)):
        for step in script:
            if step == 'each':
                for well in batch:
                    do['give'](50, well)
            elif isinstance(step, tuple) and step[0] == 'take':
                do['take'](step[1], source)
            elif isinstance(step, tuple):
                do[step[0]](step[1])
            else:
                do[step]()
    moves = ((w, v) for w, v in zip(plate.rows()[7], range(20, 80, 10)))
    p300.pick_up_tip()
    any(p300.aspirate(v, trough['A1']).dispense(v, w) is None for w, v in moves)
    p300.drop_tip()
