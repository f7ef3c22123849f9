metadata = {'protocolName': 'Serial dilution with a warm diluent', 'apiLevel': '2.13'}


def run(ctx):
    plate = ctx.load_labware('corning_96_wellplate_360ul_flat', '1', 'dilution plate')
    res = ctx.load_labware('nest_12_reservoir_15ml', '2')
    racks = [ctx.load_labware('opentrons_96_tiprack_300ul', s) for s in ('4', '5')]
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=racks)
    diluent = res['A1']
    stock = res['A2']
    row = plate.rows()[0]

    p300.transfer(100, diluent, row[1:8])
    ctx.pause('Remove the plate, warm it to 37 C in the incubator and put it back.')
    p300.transfer(200, stock, row[0])
    for a, b in zip(row[:7], row[1:8]):
        p300.transfer(100, a, b, mix_after=(3, 100), new_tip='always')
