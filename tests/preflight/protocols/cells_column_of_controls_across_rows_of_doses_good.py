# expect: cell_treatment pass CELL-3!
"""Paclitaxel, spheroids; a row for each dose.

The vehicle control sits in column 10 of every row.
"""

metadata = {"protocolName": "Paclitaxel, spheroids", "apiLevel": "2.13"}

DOSE_OF_ROW = {"A": 1, "B": 5, "C": 25, "D": 125}  # nM


def run(ctx):
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "spheroids")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    vehicle = tubes["D6"]
    paclitaxel = dict(zip(DOSE_OF_ROW, tubes.columns()[0]))

    for row in DOSE_OF_ROW:
        p300.transfer(20, vehicle, plate[f"{row}10"], new_tip="always")
    for row, dose in DOSE_OF_ROW.items():
        ctx.comment(f"{dose} nM")
        p300.pick_up_tip()
        for column in (7, 8, 9):
            p300.transfer(20, paclitaxel[row], plate[f"{row}{column}"], new_tip="never")
        for column in (7, 8, 9):
            p300.mix(2, 60, plate[f"{row}{column}"])
        p300.drop_tip()
