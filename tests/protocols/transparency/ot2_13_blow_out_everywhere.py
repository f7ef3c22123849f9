metadata = {'apiLevel': '2.13'}


def run(ctx):
    tips = ctx.load_labware('opentrons_96_tiprack_20ul', 1)
    plate = ctx.load_labware('biorad_96_wellplate_200ul_pcr', 2)
    p20 = ctx.load_instrument('p20_single_gen2', 'left', tip_racks=[tips])
    trash = ctx.fixed_trash

    places = [None, plate['B1'], plate['B1'].top(), plate['B1'].bottom(2), trash['A1'], trash['A1'].top(5), plate['A1']]
    for place in places:
        p20.pick_up_tip()
        p20.aspirate(10, plate['A1'])
        p20.dispense(10, plate['B1'])
        p20.blow_out() if place is None else p20.blow_out(location=place)
        p20.drop_tip()
    for where in ('trash', 'source well', 'destination well'):
        p20.transfer(8, plate['A1'], plate.columns()[2][:3], blow_out=True, blowout_location=where, new_tip='always')
        p20.distribute(4, plate['A1'], plate.columns()[3][:3], blow_out=True,
                       blowout_location='source well' if where == 'destination well' else where, disposal_volume=2)
    p20.consolidate(5, plate.columns()[2][:3], plate['A5'], blow_out=True, blowout_location='destination well')
    p20.pick_up_tip()
    p20.aspirate(10, plate['A1'])
    p20.dispense(4, trash['A1'])
    p20.dispense(location=trash['A1'].top())
    p20.air_gap(5, height=3)
    p20.dispense()
    p20.drop_tip(home_after=False)
