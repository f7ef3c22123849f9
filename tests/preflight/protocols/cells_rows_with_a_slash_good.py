# expect: cell_treatment pass CELL-4!
"""Valproate on neurospheres, two rows an arm.

Plate: rows A/B = ctrl, C/D = 1 mM, E/F = 2 mM, G/H = 4 mM
"""

metadata = {"protocolName": "Valproate", "apiLevel": "2.13"}


def run(ctx):
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "neurosphere cells")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    medium, *drugs = tubes.rows()[0][:4]

    for row in "AB":
        p300.transfer(50, medium, plate.rows_by_name()[row][:3], new_tip="always")
    p300.pick_up_tip()
    for drug, rows in zip(drugs, ("CD", "EF", "GH")):
        for row in rows:
            p300.transfer(50, drug, plate.rows_by_name()[row][:3], new_tip="never")
    p300.drop_tip()
