# expect: bradford warn BRD-2
"""Protein in leaf extracts, micro method.

rack on 4     A1 blank  A2 BSA 0.1  A3 BSA 0.25  A4 BSA 0.5  A5 BSA 1 mg/ml
              C1-C6 extracts
dye trough    A1
"""

metadata = {"protocolName": "leaves, Bradford", "apiLevel": "2.13"}


def run(protocol):
    t20 = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    t300 = protocol.load_labware("opentrons_96_filtertiprack_200ul", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    trough = protocol.load_labware("nest_1_reservoir_195ml", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    upper, lower = plate.rows()[1][1:6], plate.rows()[4][1:7]

    p20.pick_up_tip()
    for tube, well in zip(rack.rows()[0], upper):
        p20.aspirate(5, tube)
        p20.dispense(5, well)
    p20.drop_tip()
    p20.pick_up_tip()
    for tube, well in zip(rack.rows()[2], lower):
        p20.transfer(5, tube, well, new_tip="never")
    p20.drop_tip()
    for well in upper + lower:
        p300.transfer(200, trough["A1"], well, mix_after=(3, 100), new_tip="always")
