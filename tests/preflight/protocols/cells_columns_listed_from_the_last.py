# expect: cell_treatment pass
"""Kinase inhibitors; the plate is filled from the right to the left so that the controls come last."""
metadata = {'apiLevel': '2.13'}
# what goes into the columns, in the order of work: column 12 first
COLUMN_ORDER = "dabrafenib trametinib vemurafenib erlotinib gefitinib afatinib lapatinib imatinib dasatinib nilotinib DMSO medium".split()

def run(protocol):
    tips = [protocol.load_labware('opentrons_96_tiprack_300ul', s) for s in ('10', '11')]
    plate = protocol.load_labware('corning_96_wellplate_360ul_flat', '1', 'assay plate')
    trough = protocol.load_labware('nest_12_reservoir_15ml', '3', 'trough')
    m300 = protocol.load_instrument('p300_multi_gen2', 'left', tip_racks=tips)

    stand = {name: trough.wells()[i] for i, name in enumerate(COLUMN_ORDER)}
    for name, column in zip(COLUMN_ORDER, reversed(plate.columns())):
        m300.transfer(50, stand[name], column[0], new_tip='always')
