import math

metadata = {
    'protocolName': 'Aliquots from 50 ml tubes',
    'author': 'lab manager',
    'apiLevel': '2.9',
}


def run(protocol):
    racks = [protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_screwcap', s) for s in ('2', '3', '5')]
    falcon = protocol.load_labware('opentrons_6_tuberack_falcon_50ml_conical', '4')
    tips = protocol.load_labware('opentrons_96_tiprack_1000ul', '1')
    p1000 = protocol.load_instrument('p1000_single_gen2', 'right', tip_racks=[tips])
    p1000.flow_rate.aspirate = 400
    p1000.flow_rate.dispense = 400

    tube = falcon['A1']
    radius = tube.diameter / 2
    height = 85.0

    def lower(volume):
        nonlocal height
        height -= volume / (math.pi * radius ** 2) * 1.05
        return tube.bottom(max(height - 5, 3))

    targets = [well for rack in racks for well in rack.wells()]
    p1000.pick_up_tip()
    for i in range(0, len(targets), 2):
        p1000.aspirate(960, lower(960))
        p1000.touch_tip(tube, v_offset=-10)
        for target in targets[i:i + 2]:
            p1000.dispense(450, target.top(-8))
        p1000.dispense(60, tube.top(-5))
    p1000.drop_tip()
