# expect: bradford fail BRD-2
metadata = {"protocolName": "Bradford, practical course", "apiLevel": "2.10"}

# rack in slot 5
#   BSA in row order, ug/ml:  A1 0 (PBS) | A2 250 | A3 500 | A4 1000
#   lysates: C1 C2 C3 C4
# plate: columns 1 and 2 = BSA, columns 3 and 4 = lysates


def run(protocol):
    tips20 = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    tips300 = protocol.load_labware("opentrons_96_tiprack_300ul", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 4)
    rack = protocol.load_labware("opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap", 5)
    reagent = protocol.load_labware("nest_12_reservoir_15ml", 6)["A1"]  # Coomassie
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips20])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips300])
    bsa = rack.rows()[0][:4]
    lysates = rack.rows()[2][:4]
    for column in plate.columns()[:2]:
        p20.pick_up_tip()
        for tube, well in zip(bsa, column):
            p20.aspirate(5, tube)
            p20.dispense(5, well)
        p20.drop_tip()
    p20.pick_up_tip()
    for number, lysate in enumerate(lysates):
        for column in plate.columns()[2:4]:
            p20.aspirate(5, lysate)
            p20.dispense(5, column[number])
    p20.drop_tip()
    for column in plate.columns()[:4]:
        for well in column[:4]:
            p300.transfer(250, reagent, well, mix_after=(3, 150), new_tip="always")
