# expect: serial_dilution pass
"""The first well gets its dye, then its buffer, then the metal; the others get both as a mix."""

metadata = {"apiLevel": "2.13", "protocolName": "DSF screen, 1:1 serial dilution"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    p = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    dye, buffer, staged, nickel = tubes["A1"], tubes["A2"], tubes["B1"], tubes["C1"]
    row = plate.rows()[0]
    p.transfer(300, dye, staged)
    p.transfer(600, buffer, staged, mix_after=(3, 200))
    p.transfer(40, dye, row[0])
    p.transfer(80, buffer, row[0])
    p.transfer(60, staged, row[1:8], new_tip="once")
    p.transfer(60, nickel, row[0], mix_after=(3, 80))
    p.transfer(60, row[:7], row[1:8], mix_after=(3, 50), new_tip="always")
