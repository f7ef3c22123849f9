# expect: cell_treatment pass
"""Nociceptor cells, capsaicin.

plate                    tubes
col 2  vehicle             tube A1
col 3  drug 10 nM          tube A2
col 4  drug 100 nM         tube A3
"""
metadata = {"apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "tubes")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3, "plate")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    vehicle, drugs = tubes["A1"], [tubes["A2"], tubes["A3"]]
    pip.transfer(20, vehicle, plate.columns()[1][1:5], new_tip="always")
    for number, drug in enumerate(drugs):
        for well in plate.columns()[number + 2][1:5]:
            pip.transfer(20, drug, well, new_tip="always")
