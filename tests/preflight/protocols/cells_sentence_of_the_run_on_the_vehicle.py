# expect: cell_treatment pass
"""Wound healing assay with inhibitors."""
metadata = {'apiLevel': '2.13'}

def run(protocol):
    tips = [protocol.load_labware('opentrons_96_tiprack_300ul', s) for s in ('10', '11')]
    plate = protocol.load_labware('corning_96_wellplate_360ul_flat', '1', 'assay plate')
    rack = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '4', 'tubes')
    p300 = protocol.load_instrument('p300_single_gen2', 'left', tip_racks=tips)

    vehicle, y27632 = rack['B1'], rack['B2']
    blebbistatin = rack['B3']
    protocol.comment('B1 is the vehicle: 0.1 % DMSO in medium')
    protocol.comment('B2 is the ROCK inhibitor Y-27632')
    protocol.comment('B3 is blebbistatin')
    for column, tube in enumerate((y27632, blebbistatin, vehicle)):
        for well in plate.columns()[column][:4]:
            p300.transfer(20, tube, well, new_tip='always')
