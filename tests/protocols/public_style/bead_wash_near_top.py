metadata = {'protocolName': 'Magnetic bead clean up', 'apiLevel': '2.15'}


def run(ctx):
    mag = ctx.load_module('magnetic module gen2', '1')
    plate = mag.load_labware('nest_96_wellplate_2ml_deep', 'sample plate')
    res = ctx.load_labware('nest_12_reservoir_15ml', '2')
    trash = ctx.load_labware('nest_1_reservoir_195ml', '3', 'liquid waste')['A1'].top()
    racks = [ctx.load_labware('opentrons_96_filtertiprack_200ul', s) for s in ('5', '6')]
    m300 = ctx.load_instrument('p300_multi_gen2', 'left', tip_racks=racks)
    beads, etoh = res['A1'], res['A3']
    samples = plate.rows()[0][:3]

    for s in samples:
        m300.pick_up_tip()
        m300.aspirate(90, beads)
        m300.dispense(90, s)
        m300.mix(5, 100, s)
        m300.drop_tip()
    mag.engage(height_from_base=5)
    for s in samples:
        m300.pick_up_tip()
        m300.aspirate(140, s)
        m300.dispense(140, trash)
        m300.drop_tip()
    for _ in range(2):
        m300.pick_up_tip()
        for s in samples:
            m300.aspirate(200, etoh)
            m300.dispense(200, s.top(-3))
            m300.blow_out(s.top(-3))
        m300.drop_tip()
        for s in samples:
            m300.pick_up_tip()
            m300.transfer(210, s, trash, new_tip='never')
            m300.drop_tip()
