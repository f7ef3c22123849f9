metadata = {'protocolName': 'Pool wells of a barcoded plate', 'author': 'single cell lab', 'apiLevel': '2.13'}


def run(ctx):
    plate = ctx.load_labware('biorad_96_wellplate_200ul_pcr', '2')
    strip = ctx.load_labware('opentrons_96_aluminumblock_generic_pcr_strip_200ul', '4')
    tube = ctx.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '5')['A1']
    m20 = ctx.load_instrument('p20_multi_gen2', 'left', tip_racks=[ctx.load_labware('opentrons_96_filtertiprack_20ul', '1')])
    p300 = ctx.load_instrument('p300_single_gen2', 'right',
                               tip_racks=[ctx.load_labware('opentrons_96_filtertiprack_200ul', '3')])

    # all twelve columns into one strip, same tips: it is one pool in the end
    m20.consolidate(5, plate.rows()[0], strip['A1'])
    p300.consolidate(55, strip.columns()[0], tube)
