# expect: bradford fail BRD-1
"""Bradford of six eluates.

Calibration rack (slot 4): B1-B3, C1-C3 = 1200, 800, 400, 160, 80, 0 ug/ml
Eluate rack (slot 6): A1..A3, D1..D3 = eluates 1 to 6
"""
metadata = {"protocolName": "Bradford 6+6", "apiLevel": "2.13"}


def run(protocol):
    small = [protocol.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (1, 2)]
    large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 3)
    curve = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 5)
    eluates = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 6)
    dye = protocol.load_labware("nest_12_reservoir_15ml", 7, "Bradford reagent")["A1"]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=small)
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])
    standards = curve.rows()[1][:3] + curve.rows()[2][:3]
    samples = eluates.rows()[0][:3] + eluates.rows()[3][:3]
    p20.pick_up_tip()
    for tube, row in zip(standards, plate.rows()):
        for well in row[:2]:
            p20.aspirate(7, tube)
            p20.dispense(7, well)
    p20.drop_tip()
    for tube, row in zip(samples, plate.rows()):
        p20.transfer(7, tube, row[2])
    for row in plate.rows()[:6]:
        for well in row[:3]:
            p300.transfer(193, dye, well, mix_after=(3, 100))
