# expect: serial_dilution pass SD-4!
"""Titration of two antisera, 1:2, one plate each.

Trough: A1 assay diluent, A2 PBS-T wash buffer for tomorrow.
Sera: tubes A1 and A2.
"""

metadata = {"protocolName": "Titration of antisera", "apiLevel": "2.13"}


def run(protocol):
    plates = [protocol.load_labware("corning_96_wellplate_360ul_flat", slot) for slot in (1, 2)]
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3, "sera")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 4)
    racks = [protocol.load_labware("opentrons_96_tiprack_300ul", 5)]
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=racks)

    for number, plate in enumerate(plates):
        source = trough.wells()[0]
        row = plate.rows()[0][:8]
        # diluent
        p300.transfer(100, source, row, new_tip="once")
        for here, there in zip([tubes.rows()[0][number], *row], row):
            p300.transfer(100, here, there, mix_after=(4, 80), new_tip="always")
