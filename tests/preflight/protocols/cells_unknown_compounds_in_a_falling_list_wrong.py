# expect: cell_treatment fail CELL-4
"""Compound KX-117 at five doses on Jurkat cells, the vehicle beside it."""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "7")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "Jurkat cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "tubes")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    vehicle = rack["D1"]
    compounds = [rack[f"A{n}"] for n in range(1, 6)]  # falling
    vehicle_control = plate.columns()[0]
    for well in vehicle_control:
        p300.transfer(20, vehicle, well, new_tip="always")
    for row in (0, 1, 2):
        p300.pick_up_tip()
        for tube, column in zip(compounds, plate.columns()[1:]):
            p300.transfer(20, tube, column[row], new_tip="never")
        p300.drop_tip()
