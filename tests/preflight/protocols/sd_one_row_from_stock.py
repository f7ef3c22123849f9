# expect: serial_dilution fail SD-4
"""Venom, twofold over ten columns; the rows are filled one at a time"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    racks = [protocol.load_labware("opentrons_96_tiprack_300ul", s) for s in (1, 4)]
    single_rack = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    block = protocol.load_labware("nest_96_wellplate_2ml_deep", 3, "dilutions")
    eight = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=racks)
    one = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[single_rack])
    saline_diluent, venom_stock = trough["A2"], trough["A9"]
    for letter, row in block.rows_by_name().items():
        liquid = venom_stock if letter == "E" else saline_diluent
        one.distribute(150, liquid, row[1:10], disposal_volume=0)
    eight.transfer(300, venom_stock, block["A1"])
    for left, right in zip(block.rows()[0][:9], block.rows()[0][1:10]):
        eight.transfer(150, left, right, mix_after=(4, 100), new_tip="always")
