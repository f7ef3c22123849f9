# expect: cell_treatment warn CELL-1 CELL-2?
"""Ten kinase inhibitors on SW480, stamped from the compound plate.

Compound plate: columns 2-11 inhibitors, column 12 DMSO vehicle. Column 1 is not used.
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    compounds = protocol.load_labware("nest_96_wellplate_200ul_flat", 1, "compound plate")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "SW480")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])

    for at in range(1, 12):
        m20.transfer(5, compounds.columns()[at][0], cells.columns()[at][0], new_tip="always")
    m20.transfer(5, compounds.columns()[10][0], cells.columns()[11][0])
