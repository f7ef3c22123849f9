metadata = {'protocolName': 'Adaptase', 'apiLevel': '2.11'}


def run(ctx):
    tubes = ctx.load_labware('opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap', '3')
    plate = ctx.load_labware('nest_96_wellplate_100ul_pcr_full_skirt', '7')
    tips20 = [ctx.load_labware('opentrons_96_filtertiprack_20ul', '4')]
    tips200 = [ctx.load_labware('opentrons_96_filtertiprack_200ul', '5')]
    p20 = ctx.load_instrument('p20_single_gen2', 'left', tip_racks=tips20)
    m300 = ctx.load_instrument('p300_multi_gen2', 'right', tip_racks=tips200)
    col = plate.columns()[4]

    ctx.pause('Remove samples and put on ice for 2 minutes. After, put the plate back.')
    for well in col:
        p20.pick_up_tip()
        p20.aspirate(11, tubes['B1'])
        p20.dispense(11, well.top())
        p20.drop_tip()
    m300.pick_up_tip()
    m300.aspirate(20, col[0])
    m300.dispense(20, plate['A8'])
    m300.drop_tip()
