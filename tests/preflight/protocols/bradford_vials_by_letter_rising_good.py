# expect: bradford pass
"""Kit vials by letter, the blank last in the map: each pass rises from it."""

metadata = {"apiLevel": "2.13", "protocolName": "Bradford, vials A-F"}
BLANK_ROW = "F"
VIALS = {"A": 1000, "B": 750, "C": 500, "D": 250, "E": 125, BLANK_ROW: 0}
STANDARD_COLUMNS = (1, 2)
SAMPLE_COLUMNS = (5, 6)


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    vials = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2)
    lysates = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3, "lysates")
    dye = protocol.load_labware("nest_1_reservoir_195ml", 6)["A1"]
    p20 = protocol.load_instrument(
        "p20_single_gen2", "left", tip_racks=[protocol.load_labware("opentrons_96_tiprack_20ul", 4)]
    )
    p300 = protocol.load_instrument(
        "p300_multi_gen2",
        "right",
        tip_racks=[protocol.load_labware("opentrons_96_tiprack_300ul", 5)],
    )

    for column in STANDARD_COLUMNS:
        p20.pick_up_tip()
        for row, amount in reversed(VIALS.items()):
            protocol.comment(f"{row}{column}: {amount} ug/mL")
            p20.aspirate(5, vials[row + "1"])
            p20.dispense(5, plate[f"{row}{column}"])
        p20.drop_tip()
    for row in "ABCDEF":
        p20.pick_up_tip()
        for column in SAMPLE_COLUMNS:
            p20.aspirate(5, lysates[f"{row}1"])
            p20.dispense(5, plate[f"{row}{column}"])
        p20.drop_tip()
    for column in STANDARD_COLUMNS + SAMPLE_COLUMNS:
        p300.transfer(200, dye, plate[f"A{column}"], mix_after=(4, 150), new_tip="always")
