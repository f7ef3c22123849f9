# expect: bradford fail BRD-4
"""Bradford: the dye goes in, then on to the reader."""

metadata = {"apiLevel": "2.15", "protocolName": "Bradford assay"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "assay plate")
    reader = protocol.load_labware("corning_96_wellplate_360ul_flat", 6, "reader plate")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    dye = protocol.load_labware("nest_12_reservoir_15ml", 3)["A1"]
    small = protocol.load_labware("opentrons_96_tiprack_20ul", 5)
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 4)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[small])
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[large])
    std_0, std_250, std_1000 = tubes.rows()[0][:3]
    sample_1, sample_2 = tubes.rows()[1][:2]
    wells = plate.columns()[0][:5]

    for source, well in zip((std_0, std_250, std_1000, sample_1, sample_2), wells):
        p20.transfer(5, source, well)
    p300.transfer(250, dye, wells, new_tip="always")
    p300.transfer(200, wells, reader.columns()[0][:5], new_tip="always")
