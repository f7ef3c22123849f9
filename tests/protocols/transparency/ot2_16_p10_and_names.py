import collections
import functools

metadata = {'apiLevel': '2.16'}

Step = collections.namedtuple('Step', 'verb args')


def program(src, dst):
    yield Step('pick_up_tip', ())
    for v in (1, 2.5, 7):
        yield Step('aspirate', (v, src))
        yield Step('dispense', (v, dst))
    yield Step('mix', (2, 5, dst))
    yield Step('blow_out', (dst.top(),))
    yield Step('touch_tip', (dst,))
    yield Step('drop_tip', ())


def run(ctx):
    rack = ctx.load_labware('opentrons_96_tiprack_10ul', 11)
    plate = ctx.load_labware('nest_96_wellplate_100ul_pcr_full_skirt', 10)
    p10 = ctx.load_instrument('p10_single', 'left', tip_racks=[rack])
    p10.nickname = 'little one'
    assert vars(p10)['nickname'] == 'little one'
    halve = functools.partial(p10.transfer, 4, new_tip='always', air_gap=1)
    for a, b in zip(plate.columns()[0], plate.columns()[1]):
        for step in program(a, b):
            getattr(p10, step.verb)(*step.args)
    halve(plate.columns()[1], plate.columns()[2])
    list(map(lambda w: p10.transfer(3, plate['A1'], w), plate.columns()[4][:2]))
