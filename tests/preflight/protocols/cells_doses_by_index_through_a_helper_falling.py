# expect: cell_treatment fail CELL-4
"""Dexamethasone from the highest to the lowest dose, one tip for each row."""

metadata = {"apiLevel": "2.14", "protocolName": "Dexamethasone on hepatocytes"}
DOSES_NM = [300, 30, 3]


def add(pipette, source, well):
    pipette.aspirate(10, source)
    pipette.dispense(10, well.bottom(2))


def run(protocol):
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "hepatocytes")
    dilutions = protocol.load_labware("nest_96_wellplate_2ml_deep", 2, "dexamethasone 10x")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_screwcap", 4, "vehicle")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    vehicle = tubes["A1"]
    vehicle_wells = [cells[row + "10"] for row in "ABCD"]

    for well in vehicle_wells:
        p20.pick_up_tip()
        add(p20, vehicle, well)
        p20.drop_tip()
    for row in "ABCD":
        p20.pick_up_tip()
        for i, dose in enumerate(DOSES_NM):
            add(p20, dilutions.rows()[0][i], cells[f"{row}{i + 2}"])
        p20.drop_tip()
