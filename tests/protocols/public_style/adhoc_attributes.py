"""Adds a volume to each reagent well and keeps count by hand."""
metadata = {
    'protocolName': 'Lysis buffer addition',
    'author': 'automation',
    'source': 'Custom Protocol Request',
    'apiLevel': '2.11',
}


def run(ctx):
    num_cols = 6
    vol = 180
    tips = ctx.load_labware('opentrons_96_filtertiprack_200ul', 6)
    res = ctx.load_labware('nest_12_reservoir_15ml', 3)
    plate = ctx.load_labware('nest_96_wellplate_2ml_deep', 2)
    m300 = ctx.load_instrument('p300_multi_gen2', 'left', tip_racks=[tips])

    buffers = res.wells()[:2]
    for b in buffers:
        b.vol_left = 7200
        b.dead = 600

    def where(amount):
        for b in buffers:
            if b.vol_left - amount * 8 >= b.dead:
                b.vol_left -= amount * 8
                return b
        raise RuntimeError('no buffer left')

    m300.pick_up_tip()
    for col in plate.rows()[0][:num_cols]:
        col.filled = getattr(col, 'filled', 0) + vol
        m300.aspirate(vol, where(vol))
        m300.dispense(vol, col.top())
        m300.air_gap(10)
        m300.dispense(10, col.top())
    m300.drop_tip()
    ctx.comment(str([(c.well_name, c.filled) for c in plate.rows()[0][:num_cols]]))
