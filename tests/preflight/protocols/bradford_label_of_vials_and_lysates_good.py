# expect: bradford pass
"""Coomassie on lysates of the knock-downs; the kit's vials stand in the front row."""

metadata = {"protocolName": "Coomassie, knock-downs", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    tips_large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 2)
    rack = protocol.load_labware(
        "opentrons_24_tuberack_nest_1.5ml_snapcap", 3, "vials and lysates"
    )
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 4, "assay")
    coomassie = protocol.load_labware("nest_1_reservoir_195ml", 5, "Coomassie")["A1"]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips_large])
    left, right = plate.columns()[0][:5], plate.columns()[1][:6]

    p20.pick_up_tip()
    for vial, well in zip(rack.rows()[0][:5], left):  # 0, 125, 250, 500, 1000 ug/mL
        p20.aspirate(5, vial)
        p20.dispense(5, well)
    p20.drop_tip()
    for tube, well in zip(rack.rows()[2], right):
        p20.transfer(5, tube, well, new_tip="always")
    for well in left + right:
        p300.transfer(195, coomassie, well, mix_after=(3, 100), new_tip="always")
