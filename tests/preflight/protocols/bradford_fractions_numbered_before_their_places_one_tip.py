# expect: bradford warn BRD-2
"""Protein in fractions of a size exclusion run.

Standards: tube rack slot 4, A1-A6 (0, 0.1, 0.2, 0.4, 0.8, 1.6 mg/mL BSA)
Fractions F1-F12: tube rack slot 4, C1-C6 and D1-D6
Plate: standards in column 1, fractions: F1-F6 in column 3, F7-F12 in column 4
"""

metadata = {"protocolName": "SEC fractions, Bradford", "apiLevel": "2.13"}


def run(protocol):
    t20 = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    t300 = protocol.load_labware("opentrons_96_filtertiprack_200ul", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    trough = protocol.load_labware("nest_1_reservoir_195ml", 5, "Bradford reagent")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    first, third, fourth = (plate.columns()[n][:6] for n in (0, 2, 3))

    p20.pick_up_tip()
    for tube, well in zip(rack.rows()[0], first):
        p20.aspirate(5, tube)
        p20.dispense(5, well)
    p20.drop_tip()
    p20.transfer(5, rack.rows()[2] + rack.rows()[3], third + fourth, new_tip="once")
    for well in first + third + fourth:
        p300.transfer(200, trough["A1"], well, mix_after=(3, 100), new_tip="always")
