# expect: cell_treatment pass
"""Staurosporine ladder on Jurkat cells."""
metadata = {'apiLevel': '2.13'}
DOSES_UM = [0.1, 1.0, 10.0]           # index -> final dose
DOSE_OF = {"A1": 0, "B1": 0, "C1": 0, "A2": 1, "B2": 1, "C2": 1, "A3": 2, "B3": 2, "C3": 2}

def run(protocol):
    tips = [protocol.load_labware('opentrons_96_tiprack_300ul', s) for s in ('10', '11')]
    plate = protocol.load_labware('corning_96_wellplate_360ul_flat', '1', 'assay plate')
    rack = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '4', 'tubes')
    p300 = protocol.load_instrument('p300_single_gen2', 'left', tip_racks=tips)

    drug_tubes = [rack['A1'], rack['A2'], rack['A3']]      # staurosporine 0.1, 1 and 10 uM
    vehicle = rack['B1']
    for control in (plate['A4'], plate['B4'], plate['C4']):
        p300.transfer(20, vehicle, control, new_tip='always')
    for well, index in DOSE_OF.items():
        p300.transfer(20, drug_tubes[index], plate[well], new_tip='always')
