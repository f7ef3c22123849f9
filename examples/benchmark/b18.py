# Tutorial: ten-fold dilution of an overnight culture with the 8-channel.
# Shows: multi-channel, a list of columns, mix(), one set of tips all the way.

metadata = {
    'protocolName': 'Tutorial 3 - ten-fold dilutions',
    'apiLevel': '2.14',
}


def run(protocol):
    tiprack = protocol.load_labware('opentrons_96_tiprack_300ul', 1)
    reservoir = protocol.load_labware('nest_12_reservoir_15ml', 4)
    plate = protocol.load_labware('corning_96_wellplate_360ul_flat', 2)
    multi = protocol.load_instrument('p300_multi_gen2', 'left', tip_racks=[tiprack])

    pbs = protocol.define_liquid('PBS', 'diluent', '#AADDFF')
    culture = protocol.define_liquid('Overnight culture', 'E. coli, OD 3', '#CCAA44')
    reservoir['A1'].load_liquid(pbs, 13000)
    for well in plate.columns()[0]:
        well.load_liquid(culture, 250)

    # PBS in columns 2 to 8
    multi.pick_up_tip()
    for n in range(2, 9):
        multi.aspirate(180, reservoir['A1'])
        multi.dispense(180, plate[f'A{n}'])
    multi.drop_tip()

    # 20 uL on to the next column each time
    multi.pick_up_tip()
    for n in range(1, 8):
        multi.mix(3, 150, plate[f'A{n}'])
        multi.aspirate(20, plate[f'A{n}'])
        multi.dispense(20, plate[f'A{n + 1}'])
        multi.mix(5, 150, plate[f'A{n + 1}'])
    multi.drop_tip()
