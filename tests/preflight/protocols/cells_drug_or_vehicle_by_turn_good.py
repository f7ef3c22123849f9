# expect: cell_treatment pass
"""Bortezomib on ten columns of a plate, vehicle on the last two; one loop gives both."""

metadata = {"apiLevel": "2.14", "protocolName": "Bortezomib, MM.1S"}


def run(ctx):
    trough = ctx.load_labware("nest_12_reservoir_15ml", 1)
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "MM.1S cells")
    racks = [ctx.load_labware("opentrons_96_filtertiprack_200ul", s) for s in (4, 5)]
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=racks)
    vehicle, bortezomib = trough["A1"], trough["A2"]
    treated_columns = cells.columns()[:10]
    vehicle_columns = cells.columns()[10:]

    for number, column in enumerate(treated_columns + vehicle_columns):
        if number < 10:
            drug = bortezomib
        else:
            drug = vehicle
        m300.transfer(20, drug, column[0])
