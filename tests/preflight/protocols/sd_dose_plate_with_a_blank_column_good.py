# expect: serial_dilution pass SD-5!
"""Dose plate of staurosporine in DMSO, two-fold, to treat HeLa cells by hand.

Column 1 is left without the drug, for the vehicle control.
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "4")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "dose plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "2")
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    vehicle, staurosporine = trough["A1"], trough["A2"]
    columns = [column[0] for column in plate.columns()]
    m300.distribute(100, vehicle, [columns[0], *columns[2:]], new_tip="once")
    m300.transfer(200, staurosporine, columns[1], new_tip="always")
    for higher, lower in zip(columns[1:], columns[2:]):
        m300.transfer(100, higher, lower, mix_after=(5, 80), new_tip="always")
