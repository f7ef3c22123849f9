import math

metadata = {'protocolName': 'qPCR part 1', 'author': 'diagnostics', 'apiLevel': '2.9'}
NUM_SAMPLES = 88


def run(ctx):
    columns = math.ceil(NUM_SAMPLES / 8)
    tips = ctx.load_labware('opentrons_96_filtertiprack_20ul', '3')
    strips = ctx.load_labware('opentrons_96_aluminumblock_generic_pcr_strip_200ul', '2', 'chilled strips')
    plate = ctx.load_labware('biorad_96_wellplate_200ul_pcr', '1')
    m20 = ctx.load_instrument('p20_multi_gen2', 'left', tip_racks=[tips])

    # the mix stands in strip columns 1 and 3, six columns' worth in each
    mm = [strips['A1'], strips['A3']]
    m20.pick_up_tip()
    for i, dest in enumerate(plate.rows()[0][:columns]):
        m20.aspirate(20, mm[i // 6])
        m20.dispense(20, dest)
    m20.drop_tip()
