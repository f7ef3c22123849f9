metadata = {'protocolName': 'Distribute with air gaps', 'apiLevel': '2.9'}


def run(ctx):
    plate1 = ctx.load_labware('nest_12_reservoir_15ml', '1')
    plate2 = ctx.load_labware('corning_96_wellplate_360ul_flat', '2')
    trash = ctx.load_labware('nest_1_reservoir_195ml', '3', 'Trash Plate')
    rack = ctx.load_labware('opentrons_96_tiprack_300ul', '4')
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=[rack])

    def share_out(vol, source, dests, overage, air):
        p300.pick_up_tip()
        for i in range(0, len(dests), 4):
            some = dests[i:i + 4]
            p300.aspirate(vol*len(some) + overage, source)
            p300.move_to(source.top())
            p300.aspirate(air)
            for well in some:
                p300.dispense(vol + air, well)
                p300.move_to(well.top())
                p300.aspirate(air)
            p300.dispense(p300.max_volume, trash['A1'])  # whatever is left
        p300.drop_tip()

    share_out(50, plate1['A1'], plate2.rows()[0], 30, 10)
    p300.pick_up_tip()
    for well in plate2.rows()[0]:
        p300.aspirate(40, well)
        p300.dispense(40, trash['A1'].top())
    p300.drop_tip()
