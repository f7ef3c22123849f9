# expect: cell_treatment warn CELL-1
"""PC-9 cells, two drugs at three doses.

1  PC-9 cell plate
     column 2     vehicle control
     columns 3-5  gefitinib, low to high
     columns 6-8  osimertinib, low to high
2  compound plate, deep well: column n is for column n of the cell plate (3-8),
     column 2 the vehicle
"""

metadata = {"apiLevel": "2.14", "protocolName": "Two inhibitors on PC-9"}


def run(protocol):
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "PC-9 cell plate")
    compounds = protocol.load_labware("nest_96_wellplate_2ml_deep", 2, "compound plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3, "medium")
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (4, 5)]
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)

    m300.pick_up_tip()
    for column in range(2, 9):
        m300.aspirate(50, trough["A1"])
        m300.dispense(50, cells[f"A{column}"].top(1))
    m300.drop_tip()
    for column in range(2, 9):
        m300.transfer(25, compounds[f"A{max(column, 3)}"], cells[f"A{column}"], mix_after=(2, 60))
