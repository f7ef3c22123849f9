# expect: bradford pass BRD-1!
"""Bradford. The curve is diluted 1:2 from tube to tube and goes onto the plate from the blank up."""

metadata = {"protocolName": "Bradford, 1:2 curve", "apiLevel": "2.14"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (7, 8)]
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=tips)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    standards = rack.rows()[0][:5]
    blank = rack["A6"]
    buffer, dye = trough["A1"], trough["A2"]
    lysates = rack.rows()[3][:3]

    p300.transfer(200, buffer, standards[1:] + [blank])
    p300.pick_up_tip()
    for strong, weak in zip(standards, standards[1:]):
        p300.aspirate(200, strong)
        p300.dispense(200, weak)
        p300.mix(5, 150, weak)
    p300.drop_tip()

    for column in plate.columns()[:2]:
        p300.pick_up_tip()
        for tube, well in zip([blank, *reversed(standards)], column):
            p300.aspirate(20, tube)
            p300.dispense(20, well)
        p300.drop_tip()
    for tube, well in zip(lysates, plate.columns()[3]):
        p300.transfer(20, tube, well)
    for well in plate.columns()[0][:6] + plate.columns()[1][:6] + plate.columns()[3][:3]:
        p300.transfer(200, dye, well, mix_after=(3, 150))
