# expect: bradford pass
"""Bradford of 6 supernatants, Flex."""

metadata = {"protocolName": "supernatants"}
requirements = {"robotType": "Flex", "apiLevel": "2.19"}

# ug/ml
RACK = [("A1", 800), ("B1", 400), ("C1", 200), ("D1", 100), ("A2", 50), ("B2", 0)]


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "C1", "tubes")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "C2")
    dye = protocol.load_labware("nest_1_reservoir_195ml", "D2", "Bradford reagent")["A1"]
    tips50 = protocol.load_labware("opentrons_flex_96_tiprack_50ul", "A1")
    tips1000 = protocol.load_labware("opentrons_flex_96_tiprack_1000ul", "B1")
    protocol.load_trash_bin("A3")
    p50 = protocol.load_instrument("flex_1channel_50", "left", tip_racks=[tips50])
    p1000 = protocol.load_instrument("flex_1channel_1000", "right", tip_racks=[tips1000])
    std_wells = plate.rows()[0][:6]
    unk_wells = plate.rows()[1][:6]

    p50.pick_up_tip()
    for (name, conc), well in zip(reversed(RACK), std_wells):
        p50.aspirate(10, rack[name])
        p50.dispense(10, well)
    p50.drop_tip()
    for tube, well in zip(rack.wells()[12:18], unk_wells):
        p50.transfer(10, tube, well)
    p1000.transfer(200, dye, std_wells + unk_wells, new_tip="always", mix_after=(3, 100))
