# expect: serial_dilution pass
"""Sample 1:10, then into an enzyme of its own volume, then on down the line."""

metadata = {"apiLevel": "2.13", "protocolName": "Digest and serial dilution"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    plate = protocol.load_labware("nest_96_wellplate_2ml_deep", 3)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 5)
    p = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    nuclease, diluent, sample = trough["A1"], trough["A3"], tubes["A1"]
    row = plate.rows()[0][:6]
    for well in [row[0], *row[2:]]:
        p.transfer(180, diluent, well, new_tip="always")
    p.transfer(30, nuclease, row[1])
    p.transfer(20, sample, row[0], mix_after=(3, 100))
    p.transfer(20, row[:5], row[1:], mix_after=(5, 40), new_tip="always")
