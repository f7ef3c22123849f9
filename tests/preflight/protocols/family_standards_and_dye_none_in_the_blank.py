# expect: bradford fail BRD-3
# DC kit, microplate format
metadata = {"apiLevel": "2.14"}


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 4)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 7)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 8)
    tips_s = protocol.load_labware("opentrons_96_tiprack_20ul", 10)
    tips_l = protocol.load_labware("opentrons_96_tiprack_300ul", 11)
    small = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips_s])
    large = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips_l])
    cal_tubes = rack.rows()[0]  # blank first, then 0.2 to 1.5 mg/ml
    blank_well, *std_wells = plate.rows()[0][:6]
    unknown_tubes = rack.rows()[3][:5]
    unknown_wells = plate.rows()[1][:5]
    dye = trough["A4"]
    small.transfer(10, cal_tubes, [blank_well, *std_wells], new_tip="always")
    small.transfer(10, unknown_tubes, unknown_wells, new_tip="always")
    for well in [*std_wells, *unknown_wells]:
        large.transfer(200, dye, well, mix_after=(4, 150))
