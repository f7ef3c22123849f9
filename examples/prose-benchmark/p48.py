"""Leishmania promastigotes in a 24-well plate.

The plate:

     1             2             3             4             5        6
A    no drug       vehicle       drug 1 uM     drug 3 uM     empty    empty
B    no drug       vehicle       drug 1 uM     drug 3 uM     empty    empty
C    no drug       vehicle       drug 1 uM     drug 3 uM     empty    empty
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    tubes = ctx.load_labware("opentrons_15_tuberack_nest_15ml_conical", 2)
    plate = ctx.load_labware("corning_24_wellplate_3.4ml_flat", 3)
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    # A1 vehicle, A2 drug low, A3 drug high
    for letter in "ABC":
        pip.transfer(50, tubes["A1"], plate[f"{letter}2"], new_tip="always")
        pip.transfer(50, tubes["A2"], plate[f"{letter}3"], new_tip="always")
        pip.transfer(50, tubes["A3"], plate[f"{letter}4"], new_tip="always")
