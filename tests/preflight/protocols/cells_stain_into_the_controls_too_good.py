# expect: cell_treatment pass
"""Doxorubicin on H9c2 cells, then Hoechst.

Cell plate: column 1 vehicle control, columns 2-4 doxorubicin.
At the end 20 uL stain into every well of rows A-D, the controls too.
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "6")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "cell plate")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    dmso, doxorubicin, hoechst = tubes["A1"], tubes["A2"], tubes["A3"]
    for row in plate.rows()[:4]:
        p300.transfer(25, dmso, row[0], new_tip="always")
        for well in row[1:4]:
            p300.transfer(25, doxorubicin, well, new_tip="always")
    for row in plate.rows()[:4]:
        for well in row[:4]:
            p300.transfer(20, hoechst, well, new_tip="always")
