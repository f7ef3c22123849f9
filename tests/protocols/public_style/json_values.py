import json

metadata = {
    'protocolName': 'Sample transfer',
    'author': 'Field Applications',
    'source': 'Protocol Library',
    'apiLevel': '2.13',
}


def get_values(*names):
    values = json.loads('{"n": 30, "vol": 140, "mount": "left", "reuse": false, "src": '
                        '"opentrons_24_tuberack_nest_1.5ml_snapcap"}')
    return [values[n] for n in names]


def run(ctx):
    n, vol, mount, src, reuse = get_values('n', 'vol', 'mount', 'src', 'reuse')
    racks = [ctx.load_labware(src, slot, f'samples {i + 1}') for i, slot in enumerate(('1', '4'))]
    dest = ctx.load_labware('nest_96_wellplate_2ml_deep', '2')
    tips = ctx.load_labware('opentrons_96_filtertiprack_200ul', '5')
    pip = ctx.load_instrument('p300_single_gen2', mount, tip_racks=[tips])

    tubes = [t for row in zip(*[r.rows() for r in racks]) for half in row for t in half][:n]
    for t, w in zip(tubes, dest.wells()):
        pip.transfer(vol, t.bottom(4), w.bottom(5), air_gap=20, new_tip='always')
        if reuse:
            pip.return_tip()
