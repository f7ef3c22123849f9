# expect: cell_treatment fail CELL-4
"""Rapamycin on HepG2.

Ramp in the rapamycin plate: 0.5 nM in column 1 up to 20 uM in column 8, vehicle in column 11.
"""

metadata = {"apiLevel": "2.12", "protocolName": "Rapamycin ramp"}

ORDER = range(7, -1, -1)


def run(ctx):
    deep = ctx.load_labware("nest_96_wellplate_2ml_deep", 1, "rapamycin")
    hepg2 = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "HepG2")
    m300 = ctx.load_instrument(
        "p300_multi_gen2", "right",
        tip_racks=[ctx.load_labware("opentrons_96_filtertiprack_200ul", 3)],
    )
    m300.transfer(30, deep["A11"], hepg2["A11"])
    m300.pick_up_tip()
    for at in ORDER:
        m300.transfer(30, deep.columns()[at], hepg2.columns()[at + 1], new_tip="never")
    m300.drop_tip()
