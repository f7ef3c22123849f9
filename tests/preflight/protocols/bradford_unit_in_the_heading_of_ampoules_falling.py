# expect: bradford fail BRD-1
"""Coomassie with ampoules of the kit.

Ampoules in rack slot 1 (ug/mL):
A1 vial A 2000   B1 vial B 1500   C1 vial C 750   D1 vial D 250
A2 vial E 125    B2 vial F 25     C2 vial G 0

Lysates in slot 2, A1 to A6.
"""

metadata = {"protocolName": "Coomassie, ampoules", "apiLevel": "2.13"}


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1, "BSA ampoules")
    lysates = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "lysates")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    trough = protocol.load_labware("nest_1_reservoir_195ml", 4, "Coomassie reagent")
    t20 = protocol.load_labware("opentrons_96_filtertiprack_20ul", 5)
    t300 = protocol.load_labware("opentrons_96_filtertiprack_200ul", 6)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    left, right = plate.columns()[0][:7], plate.columns()[1][:6]

    p20.pick_up_tip()
    for vial, well in zip(rack.wells()[:7], left):
        p20.aspirate(5, vial)
        p20.dispense(5, well)
    p20.drop_tip()
    p20.transfer(5, lysates.rows()[0], right, new_tip="always")
    for well in left + right:
        p300.transfer(200, trough["A1"], well, mix_after=(3, 100), new_tip="always")
