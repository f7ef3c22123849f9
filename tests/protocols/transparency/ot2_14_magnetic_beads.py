metadata = {'apiLevel': '2.14', 'protocolName': 'bead wash'}
COLUMNS = 3


def run(ctx):
    mag = ctx.load_module('magnetic module gen2', '1')
    mag_plate = mag.load_labware('nest_96_wellplate_2ml_deep')
    res = ctx.load_labware('nest_12_reservoir_15ml', '2')
    waste = ctx.load_labware('nest_1_reservoir_195ml', '9')['A1'].top()
    tips = [ctx.load_labware('opentrons_96_filtertiprack_200ul', s, '200 tips') for s in ('4', '5', '6')]
    parked = ctx.load_labware('opentrons_96_filtertiprack_200ul', '7', 'parked tips')
    m300 = ctx.load_instrument('p300_multi_gen2', 'right', tip_racks=tips)
    m300.flow_rate.aspirate = 50
    m300.flow_rate.dispense = 150
    m300.flow_rate.blow_out = 300

    samples = mag_plate.rows()[0][:COLUMNS]
    beads, ethanol, water = res['A1'], res['A3'], res['A12']
    parking = dict(zip(samples, parked.rows()[0]))

    def remove_supernatant(volume):
        m300.flow_rate.aspirate = 30
        for well in samples:
            m300.pick_up_tip(parking[well])
            side = -1 if samples.index(well) % 2 else 1
            m300.move_to(well.center())
            m300.aspirate(volume, well.bottom(0.7).move(type(well.center().point)(x=side, y=0, z=0)))
            m300.air_gap(15)
            m300.dispense(volume + 15, waste)
            m300.blow_out()
            m300.drop_tip(parking[well])
        m300.flow_rate.aspirate = 50

    for well in samples:
        m300.pick_up_tip()
        m300.mix(3, 150, beads)
        m300.aspirate(90, beads)
        m300.air_gap(20)
        m300.dispense(110, well)
        m300.mix(5, 80, well)
        m300.touch_tip(v_offset=-3, speed=40)
        m300.drop_tip()
    ctx.delay(minutes=1, msg='binding')
    mag.engage(height_from_base=4)
    ctx.delay(seconds=30)
    remove_supernatant(90)
    for _ in range(2):
        m300.pick_up_tip()
        for well in samples:
            m300.aspirate(150, ethanol)
            m300.dispense(150, well.top())
        m300.drop_tip()
        remove_supernatant(150)
    mag.disengage()
    for well in samples:
        m300.transfer(40, water, well, mix_after=(5, 30), new_tip='always')
    ctx.pause('Seal the plate.')
