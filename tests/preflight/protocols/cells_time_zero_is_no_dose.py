# expect: cell_treatment pass
"""Time course with TGF-beta: hours of treatment. Time 0: untreated cells are imaged, then the drug is added to all."""
metadata = {'apiLevel': '2.13'}
HOURS_UNTIL_LYSIS = {"A1": 0, "A2": 2, "A3": 6, "A4": 24}

def run(protocol):
    tips = [protocol.load_labware('opentrons_96_tiprack_300ul', s) for s in ('10', '11')]
    plate = protocol.load_labware('corning_96_wellplate_360ul_flat', '1', 'assay plate')
    rack = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '4', 'tubes')
    p300 = protocol.load_instrument('p300_single_gen2', 'left', tip_racks=tips)

    drug = rack['A1']                 # TGF-beta 5 ng/ml
    vehicle = rack['A2']
    vehicle_control = plate['B1']
    p300.transfer(20, vehicle, vehicle_control)
    for name in HOURS_UNTIL_LYSIS:
        p300.transfer(20, drug, plate[name], new_tip='always')
