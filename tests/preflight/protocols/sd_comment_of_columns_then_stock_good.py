# expect: serial_dilution pass SD-4!
"""Twofold series of a fungicide along the rows, five columns."""
metadata = {"apiLevel": "2.15"}


def run(ctx):
    plate = ctx.load_labware("nest_96_wellplate_200ul_flat", 2, "dilution plate")
    trough = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tips = [ctx.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (7, 8)]
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    columns = [column[0] for column in plate.columns()[:5]]
    stock = trough["A4"]

    # diluent columns, then stock
    m300.transfer(100, trough["A1"], columns[1:], new_tip="once")
    m300.transfer(200, stock, columns[0], new_tip="always")
    m300.transfer(100, columns[:-1], columns[1:], mix_after=(4, 80), new_tip="always")
