# expect: cell_treatment pass
metadata = {"protocolName": "Gemcitabine on A549", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 1)
    drugs = protocol.load_labware("nest_96_wellplate_2ml_deep", 2, "gemcitabine, low to high")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "A549 cells")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    vehicle = drugs["A12"]
    # cells: columns 3-6 gemcitabine; column 2 = vehicle
    for row in "BCDEFG":
        p300.transfer(20, vehicle, cells[f"{row}2"], new_tip="always")
    for number in range(4):
        for row in "BCDEFG":
            p300.transfer(
                20, drugs.wells()[8 * number], cells[f"{row}{number + 3}"], new_tip="always"
            )
