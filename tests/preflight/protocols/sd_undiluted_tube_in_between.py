# expect: serial_dilution pass
"""
Hormone standards: neat standard is thawed in tube A1 of the rack; 100 ul go into tube B1, which is empty and takes
the vial's crumbs to the bottom; these 100 ul go on into B2 with 900 ul of assay buffer: 1:10, then B3, B4 ... each 1:10.
"""
metadata = {'apiLevel': '2.13'}

def run(protocol):
    tips = [protocol.load_labware('opentrons_96_tiprack_300ul', s) for s in ('10', '11')]
    plate = protocol.load_labware('corning_96_wellplate_360ul_flat', '1', 'read plate')
    rack = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '4', 'tubes')
    p300 = protocol.load_instrument('p300_single_gen2', 'left', tip_racks=tips)

    neat, assay_buffer = rack['A1'], rack['A6']
    clear, *dilutions = rack.rows()[1][:5]
    p300.transfer(900, assay_buffer, dilutions)
    p300.transfer(100, neat, clear)
    p300.transfer(100, clear, dilutions[0], mix_after=(8, 250))
    for a, b in zip(dilutions, dilutions[1:]):
        p300.transfer(100, a, b, mix_after=(8, 250), new_tip='always')
