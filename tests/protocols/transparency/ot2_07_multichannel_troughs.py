metadata = {'apiLevel': '2.7', 'author': 'x', 'source': 'y'}


def run(ctx):
    ctx.set_rail_lights(True)
    r = ctx.load_labware('usascientific_12_reservoir_22ml', '1')
    big = ctx.load_labware('axygen_1_reservoir_90ml', '2')
    deep = ctx.load_labware('usascientific_96_wellplate_2.4ml_deep', '3')
    racks = [ctx.load_labware('opentrons_96_tiprack_300ul', str(s)) for s in (7, 8)]
    m300 = ctx.load_instrument('p300_multi_gen2', 'left', tip_racks=racks)
    m10 = ctx.load_instrument('p10_multi', 'right', tip_racks=[ctx.load_labware('opentrons_96_tiprack_10ul', '9')])
    for i in range(4):
        m300.pick_up_tip(racks[0].columns()[i][0])
        for dest in deep.columns()[i::4]:
            m300.aspirate(150, r.wells()[i])
            m300.dispense(100, dest[0].top(-5))
            m300.dispense(50, big['A1'])
        m300.drop_tip(racks[0].rows()[0][i]) if i % 2 else m300.return_tip()
    m10.distribute(2, r['A12'], deep.rows()[0][:4], disposal_volume=0)
    m10.transfer(7, deep.columns()[0], deep.columns()[5], touch_tip=True)
    m300.transfer(450, deep['A1'], deep['A12'], mix_before=(2, 200), air_gap=30)
    ctx.set_rail_lights(False)
