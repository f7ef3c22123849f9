"""Bradford, standards in the tubes of the rack:

A1  2000 micrograms per mL
A2  1000 micrograms per mL
A3  500 micrograms per mL
A4  250 micrograms per mL
A5  0 micrograms per mL
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "4")
    large = protocol.load_labware("opentrons_96_tiprack_300ul", "5")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "rack")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "3", "Bradford reagent")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    m300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[large])
    p20.pick_up_tip()
    for standard, well in zip(rack.rows()[0][4::-1], plate.columns()[0]):
        p20.transfer(5, standard, well, new_tip="never")
    p20.drop_tip()
    m300.transfer(200, trough["A1"], plate["A1"], mix_after=(3, 100))
