# expect: cell_treatment pass
"""
Antagonist mode, beta-2 receptor in HEK cells: propranolol by column, then isoproterenol (agonist)
at EC80 into every well. The agonist stands in three tubes, one for each pair of columns.
"""
metadata = {'apiLevel': '2.13'}
PROPRANOLOL_NM = {1: 0, 2: 1, 3: 10, 4: 100, 5: 1000, 6: 10000}

def run(protocol):
    tips = [protocol.load_labware('opentrons_96_tiprack_300ul', s) for s in ('10', '11')]
    plate = protocol.load_labware('corning_96_wellplate_360ul_flat', '1', 'assay plate')
    rack = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '4', 'tubes')
    p300 = protocol.load_instrument('p300_single_gen2', 'left', tip_racks=tips)

    antagonist = {1: rack['A1'], 10: rack['A2'], 100: rack['A3'], 1000: rack['A4'], 10000: rack['A5']}
    vehicle = rack['A6']
    agonist = [rack['B1'], rack['B2'], rack['B3']]
    for column, dose in PROPRANOLOL_NM.items():
        for well in plate.columns()[column - 1][:3]:
            p300.transfer(20, antagonist.get(dose, vehicle), well, new_tip='always')
    for column in PROPRANOLOL_NM:
        for well in plate.columns()[column - 1][:3]:
            p300.transfer(20, agonist[(column - 1) // 2], well.top(), new_tip='always')
