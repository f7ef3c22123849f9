# expect: bradford fail BRD-1
"""Biuret of whey.

Calibration strip: A1 lysis buffer (blank), B1 BSA 1 mg/ml, C1 BSA 2 mg/ml, D1 BSA 5 mg/ml, E1 BSA 10 mg/ml
"""

metadata = {"protocolName": "whey, biuret", "apiLevel": "2.13"}


def run(protocol):
    strip = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "calibration strip")
    whey = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "whey samples")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "biuret")
    trough = protocol.load_labware("nest_1_reservoir_195ml", 4, "biuret reagent")
    t20 = protocol.load_labware("opentrons_96_filtertiprack_20ul", 5)
    t300 = protocol.load_labware("opentrons_96_filtertiprack_200ul", 6)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    curve, rest = plate.columns()[2][:5], plate.columns()[5]

    p20.pick_up_tip()
    for source, well in zip(strip.columns()[0][1:5] + strip.columns()[0][:1], curve[1:] + curve[:1]):
        p20.aspirate(10, source)
        p20.dispense(10, well)
    p20.drop_tip()
    for source, well in zip(whey.wells(), rest):
        p20.transfer(10, source, well)
    for well in curve + rest:
        p300.transfer(200, trough["A1"], well, mix_after=(3, 100), new_tip="always")
