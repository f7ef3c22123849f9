# expect: cell_treatment pass CELL-1!
# compound plate (slot 1): column 1 = K, column 2 = L, column 12 = vehicle (DMSO)
# cell plate (slot 2):     columns 1-3 K, 4-6 L, 10-11 vehicle controls, 12 untreated cells

metadata = {"apiLevel": "2.15", "protocolName": "Two compounds on cells"}


def run(protocol):
    compounds = protocol.load_labware("nest_96_wellplate_200ul_flat", 1, "compound plate")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "cell plate")
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])

    for source, columns in (("A12", (10, 11)), ("A1", (1, 2, 3)), ("A2", (4, 5, 6))):
        m300.pick_up_tip()
        for column in columns:
            m300.aspirate(25, compounds[source])
            m300.dispense(25, cells[f"A{column}"])
        m300.drop_tip()
