metadata = {'protocolName': 'Coat many plates', 'author': 'ELISA', 'apiLevel': '2.12'}

PLATES = 4


def run(ctx):
    tips = ctx.load_labware('opentrons_96_tiprack_300ul', '1')
    plate = ctx.load_labware('corning_96_wellplate_360ul_flat', '2')
    coat = ctx.load_labware('nest_1_reservoir_195ml', '3')
    m300 = ctx.load_instrument('p300_multi_gen2', 'left', tip_racks=[tips])

    m300.pick_up_tip()
    for number in range(PLATES):
        if number:
            ctx.pause('Take plate %d away and put a new, empty plate %d in slot 2.' % (number, number + 1))
        for column in plate.rows()[0]:
            m300.aspirate(150, coat['A1'])
            m300.dispense(150, column)
    m300.drop_tip()
