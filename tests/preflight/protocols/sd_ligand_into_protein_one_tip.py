# expect: serial_dilution fail SD-5
"""Every well holds the protein; zinc is diluted through it."""

metadata = {"apiLevel": "2.13", "protocolName": "Titration of zinc, 12 points, 1:2"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 5)
    p = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    protein, zinc = trough["A1"], tubes["A1"]
    row = plate.rows()[0]
    p.transfer(100, protein, row, new_tip="once")
    p.transfer(50, zinc, row[0], mix_after=(3, 80))
    p.transfer(50, row[:10], row[1:11], mix_after=(3, 80), new_tip="once")
