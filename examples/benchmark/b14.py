from opentrons import protocol_api

metadata = {'protocolName': 'Cisplatin dose response, HeLa', 'apiLevel': '2.14'}

# dilution strip: tube 1 = 100 uM, 2 = 33 uM, 3 = 11 uM, 4 = 3.7 uM, 5 = 1.2 uM, 6 = 0.4 uM
CISPLATIN_UM = [100, 33, 11, 3.7, 1.2, 0.4]


def run(protocol: protocol_api.ProtocolContext):
    plate = protocol.load_labware('corning_24_wellplate_3.4ml_flat', 3, label='HeLa 24-well plate')
    rack = protocol.load_labware('opentrons_24_tuberack_eppendorf_2ml_safelock_snapcap', 2, label='Compound tubes')
    tiprack = protocol.load_labware('opentrons_96_tiprack_300ul', 1)
    p300 = protocol.load_instrument('p300_single_gen2', 'right', tip_racks=[tiprack])

    hela = protocol.define_liquid('HeLa cells', 'in 900 uL DMEM', '#aaffaa')
    saline = protocol.define_liquid('Vehicle', '0.9 % saline', '#eeeeee')
    for well in plate.wells():
        well.load_liquid(hela, 900)
    cisplatin = {}
    for dose, tube in zip(CISPLATIN_UM, rack.rows()[0]):
        tube.load_liquid(protocol.define_liquid(f'cisplatin {dose} uM', 'drug in saline', '#ff8844'), 1000)
        cisplatin[dose] = tube
    rack['B1'].load_liquid(saline, 1500)

    # rows A-C: one dose per column; row D: vehicle control
    vehicle_wells = plate.rows()[3]
    p300.transfer(100, rack['B1'], vehicle_wells, new_tip='always')

    p300.pick_up_tip()
    for column, dose in enumerate(CISPLATIN_UM):
        for row in 'ABC':
            p300.aspirate(100, cisplatin[dose])
            p300.dispense(100, plate[f'{row}{column + 1}'])
    p300.drop_tip()
