# expect: cell_treatment pass
"""
Treatment of A549 cells with gefitinib.

C = medium control, D = DMSO control, G = gefitinib 5 uM
column   1 2 3 4 5 6
         C C D D G G      (rows A to H the same)
"""
metadata = {'apiLevel': '2.13'}
ROWS = "ABCDEFGH"

def run(protocol):
    tips = [protocol.load_labware('opentrons_96_tiprack_300ul', s) for s in ('10', '11')]
    cells = protocol.load_labware('corning_96_wellplate_360ul_flat', '1', 'A549 cells')
    rack = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '4', 'treatments')
    p300 = protocol.load_instrument('p300_single_gen2', 'left', tip_racks=tips)
    medium, dmso, gefitinib = rack['A1'], rack['A2'], rack['A3']
    for source, columns in ((medium, (1, 2)), (dmso, (3, 4)), (gefitinib, (5, 6))):
        for column in columns:
            for row in ROWS:
                p300.pick_up_tip()
                p300.aspirate(30, source)
                p300.dispense(30, cells[f"{row}{column}"])
                p300.drop_tip()
