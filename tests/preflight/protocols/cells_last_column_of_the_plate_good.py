# expect: cell_treatment pass CELL-2!
"""Dexamethasone on macrophages.

1  macrophage cell plate
     columns 1-9    treated, three doses
     columns 10-12  vehicle control (ethanol)
2  trough: A1 10 nM, A2 100 nM, A3 1000 nM drug, A12 vehicle
"""

metadata = {"apiLevel": "2.14", "protocolName": "Dexamethasone"}


def run(protocol):
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "macrophage cell plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2, "drug and vehicle")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 4)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    columns = [column[0] for column in cells.columns()]

    m20.pick_up_tip()
    for at in range(9, len(columns)):
        m20.aspirate(10, trough["A12"])
        m20.dispense(10, columns[at])
    m20.drop_tip()
    for dose in range(3):
        m20.transfer(10, trough.wells()[dose], columns[3 * dose : 3 * dose + 3], new_tip="once")
