metadata = {'protocolName': 'Fix, stain, wash', 'author': 'imaging', 'apiLevel': '2.10'}


def run(ctx):
    plate = ctx.load_labware('corning_96_wellplate_360ul_flat', '4')
    res = ctx.load_labware('nest_12_reservoir_15ml', '5')
    waste = ctx.load_labware('agilent_1_reservoir_290ml', '6')
    t = [ctx.load_labware('opentrons_96_tiprack_300ul', s) for s in ('7', '8', '9', '10')]
    m300 = ctx.load_instrument('p300_multi_gen2', 'left', tip_racks=t)
    cols = plate.rows()[0][:4]

    def aspirate_off():
        for c in cols:
            m300.pick_up_tip()
            m300.aspirate(100, c.bottom(0.6), rate=0.3)
            m300.dispense(100, waste['A1'].top())
            m300.drop_tip()

    def add(well):
        m300.pick_up_tip()
        for c in cols:
            m300.aspirate(100, res[well])
            m300.dispense(100, c.top(), rate=0.4)
        m300.drop_tip()

    aspirate_off()  # culture medium
    for well, minutes in (('A1', 15), ('A2', 5), ('A3', 30), ('A2', 5), ('A2', 5)):
        add(well)
        ctx.delay(minutes=minutes)
        aspirate_off()
    add('A2')
