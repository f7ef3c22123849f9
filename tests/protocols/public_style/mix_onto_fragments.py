metadata = {'protocolName': 'Fragmentation mix', 'apiLevel': '2.11'}


def run(ctx):
    plate = ctx.load_labware('nest_96_wellplate_100ul_pcr_full_skirt', '7')
    tubes = ctx.load_labware('opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap', '1')
    rack = ctx.load_labware('opentrons_96_filtertiprack_20ul', '4')
    p20 = ctx.load_instrument('p20_single_gen2', 'left', tip_racks=[rack])
    mm = tubes['A1']

    for dest in plate.wells()[:6]:
        p20.pick_up_tip()
        p20.aspirate(3.25, mm)
        p20.dispense(3.25, dest)
        p20.mix(10, 10)
        p20.blow_out()
        p20.drop_tip()
