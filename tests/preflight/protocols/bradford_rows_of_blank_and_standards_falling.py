# expect: bradford fail BRD-1
"""Lowry of hydrolysates in triplicate.

rows A-C: blank + standards in columns 1-6
rows D-F: hydrolysates
"""

metadata = {"protocolName": "Lowry, hydrolysates", "apiLevel": "2.13"}
MG_PER_ML = {"A1": 0, "A2": 0.05, "A3": 0.1, "A4": 0.2, "A5": 0.4, "A6": 0.8}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    trough = protocol.load_labware("nest_1_reservoir_195ml", 3, "Lowry reagent")
    t20 = [protocol.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (4, 7)]
    t300 = [protocol.load_labware("opentrons_96_filtertiprack_200ul", slot) for slot in (5, 8)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=t20)
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=t300)

    for row in "ABC":
        p20.pick_up_tip()
        for tube, well in reversed(list(zip(MG_PER_ML, plate.rows_by_name()[row]))):
            p20.aspirate(8, rack[tube])
            p20.dispense(8, well)
        p20.drop_tip()
    for tube, column in zip(rack.rows()[2], plate.columns()):
        p20.transfer(8, tube, column[3:6], new_tip="always")
    for column in plate.columns()[:6]:
        p300.transfer(200, trough["A1"], column[:6], mix_after=(3, 100), new_tip="always")
