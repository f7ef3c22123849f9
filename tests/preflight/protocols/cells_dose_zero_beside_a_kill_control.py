# expect: cell_treatment pass
"""Compound screen, kill control staurosporine."""
metadata = {'apiLevel': '2.13'}
# uM of CX-77; 0 where the well gets staurosporine as the kill control
CX77_UM = {"A1": 0.3, "A2": 1, "A3": 3, "A4": 10, "A5": 30, "A6": 0, "B6": 0}

def run(protocol):
    tips = [protocol.load_labware('opentrons_96_tiprack_300ul', s) for s in ('10', '11')]
    plate = protocol.load_labware('corning_96_wellplate_360ul_flat', '1', 'assay plate')
    rack = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '4', 'tubes')
    p300 = protocol.load_instrument('p300_single_gen2', 'left', tip_racks=tips)

    cx77_drug = {0.3: rack['A1'], 1: rack['A2'], 3: rack['A3'], 10: rack['A4'], 30: rack['A5']}
    staurosporine = rack['C1']
    dmso = rack['D1']
    dmso_controls = plate.rows()[7][:6]
    for well in dmso_controls:
        p300.transfer(20, dmso, well, new_tip='always')
    for name, dose in CX77_UM.items():
        p300.transfer(20, cx77_drug.get(dose, staurosporine), plate[name], new_tip='always')
