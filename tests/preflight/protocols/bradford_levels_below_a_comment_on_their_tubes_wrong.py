# expect: bradford fail BRD-1
"""Coomassie assay of whey, standards by hand in the rack."""

metadata = {"apiLevel": "2.13"}

# BSA, mg/mL in tubes A1..A6
CURVE = (2.0, 1.0, 0.5, 0.25, 0.125, 0.0)


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "4")
    large = protocol.load_labware("opentrons_96_tiprack_300ul", "5")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "tubes")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "3", "Coomassie reagent")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    m300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[large])
    p20.pick_up_tip()
    for standard, well in zip(rack.rows()[0], plate.columns()[0]):
        p20.transfer(10, standard, well, new_tip="never")
    p20.drop_tip()
    m300.transfer(200, trough["A1"], plate["A1"], mix_after=(3, 100))
