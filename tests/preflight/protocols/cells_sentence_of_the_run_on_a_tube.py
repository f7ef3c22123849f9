# expect: cell_treatment pass
"""Drug addition."""
metadata = {'apiLevel': '2.13'}

def run(protocol):
    tips = [protocol.load_labware('opentrons_96_tiprack_300ul', s) for s in ('10', '11')]
    plate = protocol.load_labware('corning_96_wellplate_360ul_flat', '1', 'assay plate')
    rack = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '4', 'tubes')
    p300 = protocol.load_instrument('p300_single_gen2', 'left', tip_racks=tips)

    protocol.comment('A1 is the vehicle tube, A2 is the paclitaxel tube.')
    protocol.comment('A1 is filled first so that the vehicle controls come before the drug')
    protocol.comment('Plate: column 1 is drug, column 12 is vehicle control.')
    vehicle, paclitaxel = rack['A1'], rack['A2']
    for well in plate.columns()[11]:
        p300.transfer(20, vehicle, well, new_tip='always')
    for well in plate.columns()[0]:
        p300.transfer(20, paclitaxel, well, new_tip='always')
