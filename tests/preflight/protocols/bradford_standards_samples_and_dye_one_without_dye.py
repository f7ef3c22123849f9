"""Plate for the reader, written for the new student."""

metadata = {"protocolName": "Protein plate", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    tips_large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 2)
    standards = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    samples = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 5)
    dye = protocol.load_labware("nest_1_reservoir_195ml", 6)["A1"]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips_large])
    left, right = plate.columns()[0][:6], plate.columns()[1]

    for tube, well in zip(standards.rows()[0], left):
        p20.transfer(10, tube, well, new_tip="always")
    for tube, well in zip(samples.wells(), right):
        p20.transfer(10, tube, well, new_tip="always")
    for well in left + right[:7]:
        p300.transfer(190, dye, well, mix_after=(3, 100), new_tip="always")
