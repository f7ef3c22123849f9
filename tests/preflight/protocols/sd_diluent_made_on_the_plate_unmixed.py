# expect: serial_dilution fail SD-1
"""Copper titration: the last well is the zero point and shares its buffer out to the others."""

metadata = {"apiLevel": "2.13", "protocolName": "Copper two fold dilution"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    p = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    indicator, copper = tubes["A1"], tubes["A2"]
    row = plate.rows()[0][:6]
    p.transfer(300, indicator, row[5])
    p.pick_up_tip()
    for well in row[1:5]:
        p.aspirate(50, row[5])
        p.dispense(50, well)
    p.drop_tip()
    p.transfer(100, copper, row[0])
    p.transfer(50, row[:4], row[1:5], new_tip="always")
