metadata = {'protocolName': 'Plating and dilution with acetonitrile', 'apiLevel': '2.12'}


def run(ctx):
    rack = ctx.load_labware('opentrons_24_tuberack_eppendorf_2ml_safelock_snapcap', '1')
    plate = ctx.load_labware('nest_96_wellplate_2ml_deep', '3')
    res = ctx.load_labware('nest_12_reservoir_15ml', '7')
    tips1 = ctx.load_labware('opentrons_96_tiprack_300ul', '8')
    tips2 = ctx.load_labware('opentrons_96_tiprack_300ul', '10')
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=[tips1])
    m300 = ctx.load_instrument('p300_multi_gen2', 'right', tip_racks=[tips2])

    for source, dest in zip(rack.wells(), plate.wells()):
        p300.pick_up_tip()
        p300.aspirate(30, source)
        p300.air_gap(10)
        p300.dispense(40, dest.bottom(12.5))
        p300.blow_out()
        p300.drop_tip()

    ctx.pause('Press Resume on the Opentrons app to continue')

    acetonitrile = res.wells()[2]
    m300.pick_up_tip()
    for col in plate.rows()[0][:3]:
        m300.aspirate(90, acetonitrile)
        m300.dispense(90, col.center())
        m300.blow_out(col.center())
    m300.drop_tip()
