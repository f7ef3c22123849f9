# expect: cell_treatment warn CELL-1 CELL-2
"""Two plates of A549.
Plate 1: columns 1-2 vehicle, columns 3-4 pazopanib.  Plate 2: columns 1-2 pazopanib, columns 3-4 vehicle.
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", s) for s in ("10", "11")]
    plate_a = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "plate 1")
    plate_b = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", "plate 2")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "3", "reagents")
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    vehicle, pazopanib = trough["A1"], trough["A2"]
    orders = {
        plate_a: (vehicle, vehicle, pazopanib, pazopanib),
        plate_b: (vehicle, vehicle, pazopanib, pazopanib),
    }
    for plate, order in orders.items():
        for column, source in enumerate(order):
            m300.transfer(50, source, plate.columns()[column][0], new_tip="always")
