metadata = {"apiLevel": "2.14", "protocolName": "Cisplatin dose response, A549"}
DOSES_UM = [0.3, 1, 3, 10]


def run(ctx):
    cells = ctx.load_labware("corning_24_wellplate_3.4ml_flat", 2, "A549 cells")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 6)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    # tubes: A1 lowest ... A4 highest dose of cisplatin, A6 0.1 % DMSO
    drug, vehicle = rack.rows()[0][:4], rack["A6"]
    vehicle_controls = cells.columns()[0]

    for well in vehicle_controls:
        p300.transfer(50, drug[0], well, new_tip="always")
    for column, source in zip((3, 4, 5, 6), drug):
        for well in cells.columns()[column - 1]:
            p300.transfer(50, source, well, new_tip="always")
