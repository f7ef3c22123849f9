# expect: generic fail GEN-1
"""Aliquots for the reader, three of each."""

metadata = {"apiLevel": "2.13"}
PLACES = [
    ("Windermere", "A1", "A"),
    ("Coniston", "A2", "B"),
    ("Derwent", "A3", "C"),
    ("Ullswater", "A4", "D"),
]


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "4")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    p300.pick_up_tip()
    for lake, tube, row in PLACES:
        for column in (1, 2, 3):
            p300.transfer(50, rack[tube], plate[f"{row}{column}"], new_tip="never")
    p300.drop_tip()
