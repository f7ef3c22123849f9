# expect: bradford warn BRD-3
"""Protein assay of nine fractions.

Tubes A1-A5 are BSA 0, 100, 200, 400, 800 ug/ml, tubes B1-C3 the fractions.
Roti-Nanoquant (1x) in channel 4, water in channel 1.
"""
metadata = {"protocolName": "Fractions", "apiLevel": "2.13"}


def run(protocol):
    small = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 2)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 5)
    res = protocol.load_labware("nest_12_reservoir_15ml", 6)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])
    tubes = rack.rows()[0][:5] + rack.rows()[1] + rack.rows()[2][:3]
    wells = plate.rows()[0] + plate.rows()[1][:2]
    for tube, well in zip(tubes, wells):
        p20.transfer(5, tube, well)
    for well in wells[:12]:
        p300.transfer(195, res.wells()[3], well, mix_after=(3, 100))
