metadata = {'protocolName': 'RNA plate set-up', 'author': 'A. Postdoc', 'apiLevel': '2.9'}


def run(ctx):

    tips = {s: ctx.load_labware('opentrons_96_filtertiprack_200ul', s) for s in ('10', '11')}
    deep = ctx.load_labware('nest_96_wellplate_2ml_deep', '1')
    elution = ctx.load_labware('nest_96_wellplate_100ul_pcr_full_skirt', '2')
    res = ctx.load_labware('nest_12_reservoir_15ml', '3')
    m300 = ctx.load_instrument('p300_multi_gen2', 'left', tip_racks=list(tips.values()))

    def chunk(total, biggest=180):
        parts = -(-total // biggest)
        return [total / parts] * int(parts)

    def with_tip(action):
        def inner(*args, **kwargs):
            m300.pick_up_tip()
            action(*args, **kwargs)
            m300.drop_tip()
        return inner

    def move(volume, source, target, top=False):
        for part in chunk(volume):
            def one(p):
                m300.aspirate(p, source)
                m300.air_gap(10)
                m300.dispense(p + 10, target.top() if top else target)
            one(part)

    @with_tip
    def buffer_to_all(source, volume):
        for column in deep.rows()[0][:6]:
            move(volume, source, column, top=True)

    @with_tip
    def stamp(column, volume):
        m300.mix(4, 150, deep.rows()[0][column])
        move(volume, deep.rows()[0][column], elution.rows()[0][column])

    buffer_to_all(res['A1'], 300)
    buffer_to_all(res['A4'], 200)
    ctx.pause('Vortex, spin, put back.')
    for column in range(6):
        stamp(column, 60)
