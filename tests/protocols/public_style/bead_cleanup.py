import math

from opentrons.types import Point

metadata = {
    'protocolName': 'SPRI clean-up',
    'author': 'NGS core',
    'source': 'Custom Protocol Request',
    'apiLevel': '2.14',
}


def run(ctx):
    samples, sample_vol, ratio, elution = 16, 25, 1.8, 22
    cols = math.ceil(samples / 8)
    mag = ctx.load_module('magdeck', '4')
    mag_plate = mag.load_labware('biorad_96_wellplate_200ul_pcr')
    out = ctx.load_labware('biorad_96_wellplate_200ul_pcr', '1', 'clean')
    res = ctx.load_labware('nest_12_reservoir_15ml', '5')
    tipracks = [ctx.load_labware('opentrons_96_filtertiprack_200ul', s) for s in ('2', '3', '6', '7', '8', '9')]
    m300 = ctx.load_instrument('p300_multi_gen2', 'left', tip_racks=tipracks)
    waste = res.wells()[11]
    mag_samples = mag_plate.rows()[0][:cols]
    x = {well: (-1 if int(well.well_name[1:]) % 2 else 1) * 1.2 for well in mag_samples}

    def supernatant(volume):
        for well in mag_samples:
            m300.pick_up_tip()
            m300.aspirate(volume, well.bottom().move(Point(x=-x[well], z=0.8)), rate=0.2)
            m300.air_gap(20)
            m300.dispense(volume + 20, waste.top())
            m300.air_gap(20)
            m300.drop_tip()

    for well in mag_samples:
        m300.pick_up_tip()
        m300.mix(5, 100, res['A1'])
        m300.aspirate(sample_vol * ratio, res['A1'])
        m300.dispense(sample_vol * ratio, well)
        m300.mix(8, 45, well)
        m300.blow_out(well.top(-2))
        m300.drop_tip()
    ctx.delay(minutes=5)
    mag.engage()
    ctx.delay(minutes=3)
    supernatant(65)
    for _ in range(2):
        m300.pick_up_tip()
        for well in mag_samples:
            m300.aspirate(150, res['A3'])
            m300.dispense(150, well.top())
        m300.drop_tip()
        ctx.delay(seconds=30)
        supernatant(150)
    ctx.delay(minutes=4, msg='drying')
    mag.disengage()
    for well in mag_samples:
        m300.pick_up_tip()
        m300.aspirate(elution, res['A5'])
        m300.dispense(elution, well.bottom().move(Point(x=x[well], z=2)))
        m300.mix(10, 20, well)
        m300.drop_tip()
    mag.engage()
    ctx.delay(minutes=2)
    for s, d in zip(mag_samples, out.rows()[0]):
        m300.transfer(20, s.bottom(0.8), d, new_tip='always')
    mag.disengage()
