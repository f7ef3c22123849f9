metadata = {'apiLevel': '2.10', 'protocolName': 'plate copies', 'author': 'someone@lab'}

RECIPE = [
    ('tip', {}),
    ('mix', dict(repetitions=3, volume=100)),
    ('up', dict(volume=120)),
    ('down', dict(volume=60)),
    ('down', dict(volume=60)),
    ('out', {}),
    ('bin', {}),
]


def run(ctx):
    source = ctx.load_labware('nest_96_wellplate_2ml_deep', '4', 'Source')
    copies = [ctx.load_labware('nest_96_wellplate_200ul_flat', s, 'Copy %s' % s) for s in ('5', '6')]
    tips = [ctx.load_labware('opentrons_96_tiprack_300ul', '1')]
    m300 = ctx.load_instrument('p300_multi_gen2', 'left', tip_racks=tips)
    acts = {
        'tip': m300.pick_up_tip,
        'up': m300.aspirate,
        'down': m300.dispense,
        'out': m300.blow_out,
        'bin': m300.drop_tip,
        'mix': m300.mix,
    }
    for column in range(12):
        places = iter([copies[0].columns()[column][0], copies[1].columns()[column][0]])
        for act, kwargs in RECIPE:
            if act in ('up', 'mix'):
                acts[act](location=source.columns()[column][0], **kwargs)
            elif act == 'down':
                acts[act](location=next(places), **kwargs)
            elif act == 'out':
                acts[act](copies[1].columns()[column][0].top())
            else:
                acts[act](**kwargs)
