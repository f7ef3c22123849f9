from opentrons import protocol_api

metadata = {
    'protocolName': 'Virus stock, half-log dilutions for TCID50',
    'author': 'BSL-2 suite',
    'apiLevel': '2.13',
}

FACTOR = 3.162
TOTAL = 300
CARRY = round(TOTAL / FACTOR)


def run(protocol: protocol_api.ProtocolContext):
    block = protocol.load_labware('usascientific_96_wellplate_2.4ml_deep', '1', 'dilution block')
    media = protocol.load_labware('agilent_1_reservoir_290ml', '2', 'infection medium')
    virus_rack = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_screwcap', '3', 'virus')
    tips = protocol.load_labware('opentrons_96_filtertiprack_200ul', '4')
    p300 = protocol.load_instrument('p300_single_gen2', 'right', tip_racks=[tips])

    diluent = media['A1']
    virus_stock = virus_rack['A1']
    dilutions = block.rows()[0][:9]

    # 205 uL medium in each
    p300.pick_up_tip()
    for well in dilutions:
        for _ in range(2):
            p300.aspirate((TOTAL - CARRY) / 2, diluent)
            p300.dispense((TOTAL - CARRY) / 2, well)
    p300.drop_tip()

    previous = virus_stock
    for well in dilutions:
        p300.pick_up_tip()
        p300.aspirate(CARRY, previous)
        p300.dispense(CARRY, well)
        previous = well
        if well is not dilutions[-1]:
            p300.drop_tip()
    p300.mix(8, 150, previous)
    p300.drop_tip()
