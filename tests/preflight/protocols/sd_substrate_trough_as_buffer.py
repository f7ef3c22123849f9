# expect: serial_dilution fail SD-4
"""Antibody titration 1:2.

Reservoir: 1 sample buffer, 2 TMB substrate, 3 sample buffer, 5 wash buffer
"""

metadata = {"protocolName": "antibody titration 1:2", "apiLevel": "2.13"}


def run(protocol):
    trough = protocol.load_labware("nest_12_reservoir_15ml", 7)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    antibody = protocol.load_labware("nest_96_wellplate_2ml_deep", 4, "antibody 1:100")
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", s) for s in (8, 9)]
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    buffers = [trough.wells()[n] for n in (0, 1)]
    row = plate.rows()[0][:8]

    m300.pick_up_tip()
    for number, column in enumerate(row[1:]):
        m300.aspirate(100, buffers[number // 4])
        m300.dispense(100, column)
    m300.drop_tip()
    m300.transfer(200, antibody["A1"], row[0])
    for one, other in zip(row, row[1:]):
        m300.transfer(100, one, other, mix_after=(4, 90), new_tip="always")
