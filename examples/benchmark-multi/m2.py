import csv

metadata = {
    'protocolName': 'Fluorescein calibration, 1:4 steps',
    'author': 'Plate reader validation',
    'apiLevel': '2.14',
}

# from, to, mixing cycles
STEPS = '''from,to,cycles
A1,A2,5
A2,A3,5
A3,A4,5
A4,A5,5
A4,A6,5
A6,A7,5
A7,A8,5
A8,A9,5
A9,A10,0
'''


def run(protocol):
    plate = protocol.load_labware('corning_96_wellplate_360ul_flat', 1, label='Calibration plate')
    trough = protocol.load_labware('nest_12_reservoir_15ml', 2, label='Trough')
    tube = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', 3, label='Fluorescein')
    tiprack = protocol.load_labware('opentrons_96_tiprack_300ul', 4)
    p300 = protocol.load_instrument('p300_single_gen2', 'right', tip_racks=[tiprack])

    borate = trough['A1']
    wash = trough['A2']
    stock = tube['A1']
    borate.load_liquid(protocol.define_liquid('Borate buffer', 'diluent, pH 9', '#eeeeff'), 10000)
    wash.load_liquid(protocol.define_liquid('Wash buffer', 'PBS with Tween-20', '#ddffdd'), 10000)
    stock.load_liquid(protocol.define_liquid('Fluorescein stock', '10 uM', '#ccff00'), 1000)

    series = [plate.wells_by_name()[f'A{n}'] for n in range(1, 11)]

    # diluent
    for n, well in enumerate(series[1:], start=2):
        p300.pick_up_tip()
        p300.aspirate(150, trough['A2'] if n == 8 else trough['A1'])
        p300.dispense(150, well)
        p300.drop_tip()

    # neat stock
    p300.transfer(200, stock, series[0])

    # series
    for step in csv.DictReader(STEPS.splitlines()):
        p300.pick_up_tip()
        p300.aspirate(50, plate[step['from']])
        p300.dispense(50, plate[step['to']])
        if int(step['cycles']):
            p300.mix(int(step['cycles']), 100, plate[step['to']])
        p300.drop_tip()
