import json
import os

metadata = {'protocolName': 'Daily controls', 'author': 'automation', 'apiLevel': '2.7'}


def run(ctx):
    folder = '/data/tips'
    log = os.path.join(folder, 'tip_log.json')
    racks = [ctx.load_labware('opentrons_96_filtertiprack_200ul', s) for s in ('7', '8')]
    plate = ctx.load_labware('nest_96_wellplate_2ml_deep', '1')
    tubes = ctx.load_labware('opentrons_24_tuberack_nest_2ml_screwcap', '2')
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=racks)

    start = 0
    if not ctx.is_simulating():
        if os.path.isfile(log):
            with open(log) as handle:
                start = json.load(handle)['p300']
    all_tips = [t for rack in racks for t in rack.wells()]
    count = start

    def pick_up():
        nonlocal count
        if count == len(all_tips):
            ctx.pause('Replace the tip racks.')
            p300.reset_tipracks()
            count = 0
        p300.pick_up_tip(all_tips[count])
        count += 1

    for i, tube in enumerate(tubes.wells()[:10]):
        pick_up()
        p300.aspirate(150, tube)
        p300.dispense(50, plate.rows()[0][i])
        p300.dispense(50, plate.rows()[1][i])
        p300.dispense(50, plate.rows()[2][i])
        p300.blow_out()
        p300.drop_tip()

    if not ctx.is_simulating():
        os.makedirs(folder, exist_ok=True)
        with open(log, 'w') as handle:
            json.dump({'p300': count}, handle)
