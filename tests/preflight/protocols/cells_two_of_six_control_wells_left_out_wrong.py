# expect: cell_treatment warn CELL-2
"""Three inhibitors on PC3 cells. Plate: six wells A2-F2 vehicle control, columns 3, 4 and 5 one
inhibitor each, rows A to F.
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "7")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "PC3 cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "inhibitors")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    vehicle = rack["D6"]
    for row in "ABCD":
        p300.transfer(25, vehicle, plate[f"{row}2"], new_tip="always")
    for column, tube in ((3, "A1"), (4, "A2"), (5, "A3")):
        for row in "ABCDEF":
            p300.transfer(25, rack[tube], plate[f"{row}{column}"], new_tip="always")
