metadata = {'protocolName': 'Standards for an ELISA', 'apiLevel': '2.9'}


def run(ctx):
    res = ctx.load_labware('nest_12_reservoir_15ml', '1')
    plate = ctx.load_labware('nest_96_wellplate_2ml_deep', '2', 'standards plate')
    racks = [ctx.load_labware('opentrons_96_tiprack_300ul', s) for s in ('4', '5')]
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=racks)
    standard_diluent = res['A1']
    row = plate.rows()[0]

    p300.pick_up_tip()
    for d in row[1:8]:
        for _ in range(2):
            p300.aspirate(250, standard_diluent)
            p300.dispense(500, d.bottom(2))  # all of it
    p300.drop_tip()

    # the first well holds the standard
    for s, d in zip(row[:7], row[1:8]):
        p300.pick_up_tip()
        for _ in range(2):
            p300.aspirate(250, s)
            p300.dispense(250, d)
        p300.mix(5, 200, d)
        p300.drop_tip()
