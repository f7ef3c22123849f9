# expect: bradford fail BRD-1
# rack in slot 2: A1 = PBS (0), A2 = 0.1, A3 = 0.4, A4 = 0.8 mg/ml BSA, B1-B6 urine
metadata = {"apiLevel": "2.13", "protocolName": "urinary protein"}


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    dye = protocol.load_labware("nest_1_reservoir_195ml", 3)["A1"]  # Coomassie
    small = protocol.load_labware("opentrons_96_filtertiprack_20ul", 4)
    large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])

    order = ["A4", "A3", "A2", "A1"]
    p20.pick_up_tip()
    for tube, well in zip(order, plate.columns()[0]):
        p20.transfer(5, rack[tube], well, new_tip="never")
    p20.drop_tip()
    for tube, well in zip(rack.rows()[1], plate.columns()[1]):
        p20.transfer(5, tube, well)
    for well in plate.columns()[0][:4] + plate.columns()[1][:6]:
        p300.transfer(195, dye, well, new_tip="always", mix_after=(3, 100))
