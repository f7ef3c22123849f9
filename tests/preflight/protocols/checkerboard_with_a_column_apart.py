# expect: cell_treatment pass
# Two inhibitors against each other on PANC-1, every release from above the wells
#
#          col 3   4    5      9
# row B    X 0                 untreated
# row C    X 2 uM              untreated
# row D    X 20 uM             untreated
#
# B3 has neither: the vehicle control, two shares of vehicle. A zero is made up for with vehicle.

metadata = {"protocolName": "Inhibitor checkerboard", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", "1")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", "PANC-1 cells")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "3", "inhibitors 20x")
    vehicle = tubes["A1"]
    inhibitor_x = {"C": tubes["C1"], "D": tubes["C2"]}
    inhibitor_y = {4: tubes["D1"], 5: tubes["D2"]}

    def give(source, wells):
        p20.pick_up_tip()
        for well in wells:
            p20.aspirate(10, source)
            p20.dispense(10, well.top())
        p20.drop_tip()

    give(vehicle, [cells[f"B{column}"] for column in (3, 4, 5)])
    give(vehicle, [cells[f"{row}3"] for row in "BCD"])
    for row, inhibitor in inhibitor_x.items():
        give(inhibitor, [cells[f"{row}{column}"] for column in (3, 4, 5)])
    for column, inhibitor in inhibitor_y.items():
        give(inhibitor, [cells[f"{row}{column}"] for row in "BCD"])
