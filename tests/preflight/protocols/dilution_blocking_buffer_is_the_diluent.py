# expect: serial_dilution fail SD-3
"""
Titration of eight sera, two-fold.

slot 2   trough, A1 = blocking buffer (the diluent)
slot 3   serum plate, column 1 = eight sera
slot 5   titration plate, column 1 sera, columns 2 to 6 two-fold steps
"""

metadata = {"apiLevel": "2.14"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    sera = protocol.load_labware("nest_96_wellplate_2ml_deep", 3)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 5)
    m300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[tips])
    heads = [column[0] for column in plate.columns()[:6]]

    m300.transfer(100, trough["A1"], heads[1:5], new_tip="once")
    m300.transfer(200, sera["A1"], heads[0])
    for left, right in zip(heads, heads[1:]):
        m300.transfer(100, left, right, mix_after=(5, 100), new_tip="always")
