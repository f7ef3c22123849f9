metadata = {
    'protocolName': 'Getting started: serial dilution',
    'author': 'Teaching lab',
    'description': 'Week 2 exercise. Dilute a dye twofold along the rows of a plate.',
    'apiLevel': '2.13',
}


def run(protocol):
    # the deck
    tips = protocol.load_labware('opentrons_96_tiprack_300ul', 1)
    trough = protocol.load_labware('nest_12_reservoir_15ml', 2)
    plate = protocol.load_labware('nest_96_wellplate_200ul_flat', 3)
    pipette = protocol.load_instrument('p300_single', 'left', tip_racks=[tips])

    water = trough['A1']   # diluent
    dye = trough['A2']     # stock solution

    # every well starts with 90 uL of water
    pipette.transfer(90, water, plate.wells())

    for row in plate.rows():
        # stock into the first well of the row
        pipette.transfer(90, dye, row[0], mix_after=(3, 60))
        # and on along the row
        pipette.transfer(90, row[:11], row[1:], mix_after=(3, 60))
