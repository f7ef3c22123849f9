metadata = {
    'protocolName': 'Stop solution',
    'author': 'Assay development',
    'apiLevel': '2.12',
}


def run(protocol):
    plate = protocol.load_labware('nest_96_wellplate_200ul_flat', 3)
    res = protocol.load_labware('nest_12_reservoir_15ml', 2)
    rack = protocol.load_labware('opentrons_96_tiprack_300ul', 1)
    pip = protocol.load_instrument('p300_multi_gen2', 'right', tip_racks=[rack])

    columns = [c[0] for c in plate.columns()]
    pip.pick_up_tip()
    for c in columns:
        pip.aspirate(50, res['A1'])
        pip.dispense(50, c)
    pip.drop_tip()
    protocol.delay(minutes=10)

    # second reagent and stop: never touch
    for source in ('A2', 'A3'):
        pip.pick_up_tip()
        for c in columns:
            pip.aspirate(50, res[source])
            pip.dispense(50, c.top(1))
        pip.drop_tip()
        protocol.delay(minutes=1)
