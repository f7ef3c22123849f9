# expect: cell_treatment fail CELL-3
"""J774 with zymosan: supernatants are taken with one set of tips, from left to right."""

metadata = {"apiLevel": "2.15", "protocolName": "Zymosan on J774 macrophages, supernatants"}
TREATED = range(1, 4)
CONTROLS = range(4, 7)


def run(protocol):
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "J774 macrophages")
    collected = protocol.load_labware("nest_96_wellplate_2ml_deep", 2, "supernatants")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 4)
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])

    j774 = protocol.define_liquid("J774 cells", "in medium", "#ffeeaa")
    for well in cells.wells():
        well.load_liquid(j774, 200)
    drug = trough["A1"]  # zymosan, 10x
    medium = trough["A2"]

    def top(plate, number):
        return plate.columns()[number - 1][0]

    for number in CONTROLS:
        m300.transfer(20, medium, top(cells, number), new_tip="always")
    for number in TREATED:
        m300.transfer(20, drug, top(cells, number), new_tip="always")
    protocol.pause("6 h at 37 C under the lid; spin 5 min")

    m300.pick_up_tip()
    for number in [*TREATED, *CONTROLS]:
        m300.aspirate(100, top(cells, number))
        m300.dispense(100, top(collected, number))
    m300.drop_tip()
