"""Coomassie assay; the tubes' concentrations stand only in the lab book."""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    small = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 4)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    standards = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2).rows()[1]
    dye = protocol.load_labware("nest_12_reservoir_15ml", 5)["A1"]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[large])
    p20.pick_up_tip()
    for column in plate.columns()[:2]:
        for standard, well in zip(standards, column):
            p20.aspirate(5, standard)
            p20.dispense(5, well)
    p20.drop_tip()
    p300.transfer(150, dye, plate.rows()[0][:2], mix_after=(3, 100), new_tip="always")
