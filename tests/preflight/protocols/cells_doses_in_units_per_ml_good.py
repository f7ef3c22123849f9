# expect: cell_treatment pass
"""
IL-2 on PBMC.

Rack     A1 vehicle; B1 20 U/mL; B2 100 U/mL; B3 500 U/mL (10x)
Plate    column 2 vehicle control, column 3 2 U/mL, column 4 10 U/mL, column 5 50 U/mL
"""

metadata = {"apiLevel": "2.14"}

TUBES = {2: "A1", 3: "B1", 4: "B2", 5: "B3"}  # plate column: tube


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 6)
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "PBMC")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3, "IL-2 doses")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p20.pick_up_tip()
    for column, tube in TUBES.items():
        for well in cells.columns()[column - 1]:
            p20.aspirate(15, rack[tube])
            p20.dispense(15, well)
    p20.drop_tip()
