# expect: cell_treatment pass
"""Dose response on HeLa. Column 1 untreated, columns 2 to 7 rising doses, column 8 DMSO.

Dilution block (row A): A1 DMSO, A2..A7 doses in rising order.
"""

metadata = {"protocolName": "dose response", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "HeLa plate")
    block = protocol.load_labware("nest_96_wellplate_2ml_deep", 3, "dilution block")
    p20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    for column in (8, 2, 3, 4, 5, 6, 7):
        source = 1 if column == 8 else column
        p20.transfer(5, block[f"A{source}"], cells[f"A{column}"], new_tip="always")
