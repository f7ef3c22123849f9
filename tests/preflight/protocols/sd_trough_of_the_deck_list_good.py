# expect: serial_dilution pass
"""Interleukin standards, doubling dilutions.

Reservoir: A1 assay diluent, A2 stop solution, A3 wash
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    troughs = ctx.load_labware("nest_12_reservoir_15ml", 2)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    row = plate.rows()[0][:7]
    # diluent
    p300.transfer(100, troughs["A1"], row[1:])
    # blanks
    p300.transfer(100, troughs["A1"], plate.rows()[1][:2])
    # top standard
    p300.transfer(200, rack["A1"], row[0])
    for above, below in zip(row, row[1:]):
        p300.transfer(100, above, below, mix_after=(3, 80), new_tip="always")
