metadata = {'apiLevel': '2.11', 'protocolName': '4 x 96 to 384', 'author': 'HTS'}


def run(ctx):
    slots = ['1', '4', '7', '10']
    sources = [ctx.load_labware('nest_96_wellplate_100ul_pcr_full_skirt', s) for s in slots]
    target = ctx.load_labware('corning_384_wellplate_112ul_flat', '5')
    tips = [ctx.load_labware('opentrons_96_filtertiprack_20ul', s) for s in ('3', '6', '9', '8')]
    m20 = ctx.load_instrument('p20_multi_gen2', 'right', tip_racks=tips)

    quadrant = [(0, 0), (0, 1), (1, 0), (1, 1)]
    for source, (row, offset) in zip(sources, quadrant):
        for i, column in enumerate(source.columns()):
            m20.pick_up_tip()
            m20.aspirate(10, column[0])
            m20.dispense(10, target.columns()[2 * i + offset][row])
            m20.blow_out()
            m20.drop_tip()
