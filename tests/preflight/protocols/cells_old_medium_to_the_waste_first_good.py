# expect: cell_treatment pass
"""A431, starved: the old medium to the waste, fresh medium on, then lapatinib or DMSO."""

metadata = {"protocolName": "lapatinib on starved A431", "apiLevel": "2.14"}

VEHICLE_COLUMNS = [1, 12]
LAPATINIB_COLUMNS = [2, 3, 4, 5]


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "A431")
    troughs = ctx.load_labware("nest_12_reservoir_15ml", 2)
    waste = ctx.load_labware("nest_1_reservoir_195ml", 3, "liquid waste")["A1"]
    tips = [ctx.load_labware("opentrons_96_filtertiprack_200ul", s) for s in (7, 8, 9)]
    p300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    lapatinib, dmso, fresh_medium = troughs["A1"], troughs["A2"], troughs["A12"]

    for number in VEHICLE_COLUMNS + LAPATINIB_COLUMNS:
        p300.transfer(100, plate.columns()[number - 1][0], waste.top(), new_tip="always")
    for number in VEHICLE_COLUMNS + LAPATINIB_COLUMNS:
        p300.transfer(80, fresh_medium, plate.columns()[number - 1][0], new_tip="always")
    for number in VEHICLE_COLUMNS:
        p300.transfer(20, dmso, plate.columns()[number - 1][0], new_tip="always")
    for number in LAPATINIB_COLUMNS:
        p300.transfer(20, lapatinib, plate.columns()[number - 1][0], new_tip="always")
