# expect: cell_treatment pass CELL-1!
"""Sorafenib on HepG2; the cells are loaded as a liquid."""

metadata = {"protocolName": "Sorafenib, HepG2", "apiLevel": "2.14"}
# column: uM
DOSES = {"3": 0.5, "4": 1, "5": 2, "6": 4, "7": 8, "8": 16}
# row G: vehicle control


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "sorafenib")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    vehicle = protocol.load_labware("nest_12_reservoir_15ml", 4)["A1"]
    cells = protocol.define_liquid("HepG2 cells", "seeded yesterday", "#00AA00")
    for well in plate.wells():
        well.load_liquid(cells, 100)

    for number, column in enumerate(DOSES):
        wells = plate.columns_by_name()[column]
        p20.transfer(10, rack.wells()[number], wells[1:6], new_tip="always")
        p20.transfer(10, vehicle, wells[6], new_tip="always")
