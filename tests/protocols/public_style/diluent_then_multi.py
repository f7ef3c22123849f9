metadata = {'apiLevel': '2.6', 'protocolName': 'Titer plates', 'author': 'Vaccines'}


def run(ctx):
    plates = [ctx.load_labware('corning_96_wellplate_360ul_flat', s) for s in ('1', '2')]
    trough = ctx.load_labware('nest_12_reservoir_15ml', '3')
    tips = [ctx.load_labware('opentrons_96_tiprack_300ul', s) for s in ('4', '5', '6')]
    m300 = ctx.load_instrument('p300_multi', 'left', tip_racks=tips)

    # fill, same tips
    m300.pick_up_tip()
    for plate, diluent in zip(plates, trough.wells()):
        for col in plate.columns()[1:]:
            m300.aspirate(100, diluent)
            m300.dispense(100, col[0])
    m300.drop_tip()

    # column 1 was filled by hand
    for plate in plates:
        for i in range(10):
            m300.pick_up_tip()
            m300.aspirate(50, plate.columns()[i][0])
            m300.dispense(50, plate.columns()[i + 1][0])
            m300.mix(6, 90, plate.columns()[i + 1][0])
            m300.blow_out(plate.columns()[i + 1][0].top(-3))
            m300.drop_tip()
