metadata = {'protocolName': 'Half-medium exchange', 'author': 'Organoid facility', 'apiLevel': '2.8'}

WELLS = 12


def run(ctx):
    plate = ctx.load_labware('corning_12_wellplate_6.9ml_flat', '5')
    fresh = ctx.load_labware('opentrons_6_tuberack_falcon_50ml_conical', '2')
    bin_ = ctx.load_labware('nest_1_reservoir_195ml', '3')
    tips = ctx.load_labware('opentrons_96_filtertiprack_1000ul', '7')
    p1000 = ctx.load_instrument('p1000_single_gen2', 'left', tip_racks=[tips])
    p1000.flow_rate.aspirate = 100
    p1000.flow_rate.dispense = 60

    for well in plate.wells()[:WELLS]:
        p1000.pick_up_tip()
        p1000.aspirate(900, well.bottom(3))
        p1000.dispense(900, bin_['A1'].top(-5))
        p1000.blow_out(bin_['A1'].top())
        p1000.drop_tip()

    p1000.pick_up_tip()
    for well in plate.wells()[:WELLS]:
        p1000.aspirate(900, fresh['A1'].bottom(20))
        p1000.dispense(900, well.top(2))
    p1000.drop_tip()
