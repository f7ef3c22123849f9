# expect: cell_treatment pass
"""IL-6 release: drug, a day in the incubator, then supernatants from every well.

Macrophages: column 1 vehicle control, columns 2-4 dexamethasone 1, 10, 100 nM.
"""

metadata = {"protocolName": "IL-6 release", "apiLevel": "2.13"}


def run(ctx):
    tips = [ctx.load_labware("opentrons_96_filtertiprack_200ul", slot) for slot in (4, 5)]
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "macrophages")
    trough = ctx.load_labware("nest_12_reservoir_15ml", 2)
    storage = ctx.load_labware("nest_96_wellplate_200ul_flat", 3, "supernatants")
    vehicle = trough["A1"]
    drugs = [trough["A2"], trough["A3"], trough["A4"]]

    m300.transfer(50, vehicle, cells["A1"])
    for column, drug in zip((2, 3, 4), drugs):
        m300.transfer(50, drug, cells[f"A{column}"])
    ctx.pause("Plate to the incubator for 24 h, then return it to slot 1.")
    for column in (4, 3, 2, 1):
        m300.transfer(80, cells[f"A{column}"], storage[f"A{column}"], new_tip="always")
