# expect: cell_treatment fail CELL-1
"""Tunicamycin on fibroblasts.

      1     2-5    6
A    veh    tun   none
B    veh    tun   none
...
H    veh    tun   none

veh = vehicle control, tun = tunicamycin, none = untreated
"""

metadata = {"protocolName": "ER stress", "apiLevel": "2.13"}


def run(ctx):
    trough = ctx.load_labware("nest_12_reservoir_15ml", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "fibroblast cells")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    dmso, tunicamycin = trough["A1"], trough["A2"]

    p300.transfer(20, dmso, plate.columns()[0], new_tip="always")
    for column in plate.columns()[1:5]:
        p300.transfer(20, tunicamycin, column, new_tip="always")
    p300.transfer(20, tunicamycin, plate["E6"])
