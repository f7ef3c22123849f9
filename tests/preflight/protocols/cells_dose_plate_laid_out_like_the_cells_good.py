# expect: cell_treatment pass
"""Panobinostat on Jurkat cells.

Jurkat plate: column 1 no treatment, column 2 vehicle (PBS), columns 3-6 panobinostat
The dose plate is laid out like the Jurkat plate.
"""

metadata = {"apiLevel": "2.14", "protocolName": "Jurkat"}


def run(ctx):
    jurkat = ctx.load_labware("corning_96_wellplate_360ul_flat", 5, "Jurkat plate")
    doses = ctx.load_labware("nest_96_wellplate_2ml_deep", 4, "dose plate 5x")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 6)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])

    m300.pick_up_tip()
    for number in (2, 3, 4, 5, 6):
        m300.aspirate(25, doses[f"A{number}"])
        m300.dispense(25, jurkat[f"A{number}"])
    m300.drop_tip()
