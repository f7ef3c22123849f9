metadata = {'protocolName': 'RNA purification, two eluates', 'apiLevel': '2.15'}


def run(ctx):
    mag = ctx.load_module('magnetic module gen2', '1')
    mag_plate = mag.load_labware('nest_96_wellplate_2ml_deep')
    final = ctx.load_labware('nest_96_wellplate_100ul_pcr_full_skirt', '2', 'recipient plate')
    tubes = ctx.load_labware('opentrons_10_tuberack_falcon_4x50ml_6x15ml_conical', '3')
    tips = [ctx.load_labware('opentrons_96_filtertiprack_200ul', s) for s in ('4', '5')]
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=tips)
    elution = tubes['A3']

    for _ in range(2):
        for src, dest in zip(mag_plate.wells()[:4], final.wells()):
            p300.pick_up_tip()
            p300.aspirate(50, elution)
            p300.dispense(50, src.bottom(1.5))
            p300.mix(7, 40, src)
            p300.drop_tip()
        mag.engage(height_from_base=5)
        ctx.delay(minutes=2)
        for src, dest in zip(mag_plate.wells()[:4], final.wells()):
            # a little more than there is, to leave nothing behind
            p300.pick_up_tip()
            p300.aspirate(55, src.bottom(0.5))
            p300.dispense(55, dest)
            p300.blow_out()
            p300.drop_tip()
        mag.disengage()
