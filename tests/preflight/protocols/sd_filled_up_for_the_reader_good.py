# expect: serial_dilution pass SD-1!
"""Resorufin standards, 20 uM in column 1, 1:2 to column 8. All wells are filled up for the reader."""

metadata = {"protocolName": "Resorufin, serial dilution", "apiLevel": "2.13"}


def run(protocol):
    racks = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (1, 4)]
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    m300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=racks)
    pbs, stock = trough["A1"], trough["A2"]
    heads = plate.rows()[0][:8]

    m300.transfer(100, pbs, heads[1:], new_tip="once")
    m300.transfer(200, stock, heads[0], new_tip="once")
    for here, there in zip(heads, heads[1:]):
        m300.transfer(100, here, there, mix_after=(4, 90), new_tip="always")
    m300.pick_up_tip()
    for head in heads:
        m300.aspirate(100, pbs)
        m300.dispense(100, head.top(1))
    m300.drop_tip()
