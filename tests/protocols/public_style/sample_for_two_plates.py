metadata = {'protocolName': 'Sample transfer for two assays', 'apiLevel': '2.13'}


def run(ctx):
    samples = ctx.load_labware('biorad_96_wellplate_200ul_pcr', '1', 'sample plate')
    one = ctx.load_labware('corning_96_wellplate_360ul_flat', '2', 'destination 1')
    two = ctx.load_labware('corning_96_wellplate_360ul_flat', '3', 'destination 2')
    res = ctx.load_labware('nest_12_reservoir_15ml', '5')
    racks = [ctx.load_labware('opentrons_96_tiprack_20ul', s) for s in ('4', '6')]
    m20 = ctx.load_instrument('p20_multi_gen2', 'left', tip_racks=racks)
    water = res['A1']

    for s, d in zip(samples.rows()[0][:3], one.rows()[0]):
        m20.pick_up_tip()
        m20.aspirate(8, water)
        m20.aspirate(2, s)
        m20.dispense(10, d)
        m20.mix(3, 8, d)
        m20.drop_tip()
    for s, d in zip(samples.rows()[0][:3], two.rows()[0]):
        m20.pick_up_tip()
        m20.transfer(5, s, d, new_tip='never')
        m20.drop_tip()
