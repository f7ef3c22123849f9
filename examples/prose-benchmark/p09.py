"""
IL-8 calibrator, two-fold.

Deck
  slot 1   tips
  slot 4   12-well reservoir
             A1   assay diluent (1 % BSA in PBS)
             A2   wash buffer (PBS, 0.1 % Tween)
  slot 6   tube rack, A1 = IL-8 stock
  slot 5   calibrator plate, row C: C1 undiluted, C2 to C8 two-fold steps
"""

metadata = {"apiLevel": "2.14"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 4)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 6)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 5)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    row = plate.rows_by_name()["C"]

    p300.transfer(100, reservoir["A2"], row[1:8], new_tip="once")
    p300.transfer(200, rack["A1"], row[0])
    for left, right in zip(row[:7], row[1:8]):
        p300.transfer(100, left, right, mix_after=(4, 100), new_tip="always")
