# expect: cell_treatment pass
"""Report of a treatment: REPORT_COLUMNS goes into the file's head."""
metadata = {'apiLevel': '2.13'}
REPORT_COLUMNS = ["well", "medium", "vehicle", "drug", "dose", "time", "plate", "control", "cells", "operator", "date", "remark"]

def run(protocol):
    tips = [protocol.load_labware('opentrons_96_tiprack_300ul', s) for s in ('10', '11')]
    plate = protocol.load_labware('corning_96_wellplate_360ul_flat', '1', 'assay plate')
    trough = protocol.load_labware('nest_12_reservoir_15ml', '3', 'trough')
    m300 = protocol.load_instrument('p300_multi_gen2', 'left', tip_racks=tips)

    selumetinib, dmso = trough['A1'], trough['A2']
    for column in plate.columns()[:6]:
        m300.transfer(50, selumetinib, column[0], new_tip='always')
    for column in plate.columns()[9:12]:
        m300.transfer(50, dmso, column[0], new_tip='always')
    protocol.comment(";".join(REPORT_COLUMNS))
