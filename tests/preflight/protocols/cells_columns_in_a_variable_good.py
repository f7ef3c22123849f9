# expect: cell_treatment pass
"""Columns in a variable, controls by index, the drug in the other columns."""

metadata = {"apiLevel": "2.15", "protocolName": "IL-6 stimulation of HepG2"}
CTRL = [0, 1]
TREAT = [2, 3, 4]


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "HepG2 cells")
    res = protocol.load_labware("nest_12_reservoir_15ml", 5)
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (3, 6)]
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=tips)
    drug, vehicle = res["A1"], res["A2"]
    cols = plate.columns()
    for i in CTRL:
        m20.transfer(10, vehicle, cols[i][0], new_tip="always")
    for i in TREAT:
        m20.transfer(10, drug, cols[i][0], new_tip="always")
