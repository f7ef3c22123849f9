# expect: cell_treatment pass
"""
Vincristine on Jurkat, 8-channel, all rows alike.

Dilution plate (slot 2):
    columns 3-7: vincristine 9, 3, 1, 0.3, 0.1 nM
    column 10: DMSO vehicle
"""

metadata = {"protocolName": "Vincristine, Jurkat", "apiLevel": "2.14"}


def run(ctx):
    jurkat = ctx.load_labware("corning_96_wellplate_360ul_flat", "1", "Jurkat cells")
    dilutions = ctx.load_labware("nest_96_wellplate_2ml_deep", "2", "dilution plate")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", "3")
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[tips])

    m300.pick_up_tip()
    m300.transfer(25, dilutions["A10"], jurkat["A2"], new_tip="never")
    # one set of tips for the whole series
    for column in (7, 6, 5, 4, 3):
        m300.transfer(25, dilutions[f"A{column}"], jurkat[f"A{column}"], new_tip="never")
    m300.drop_tip()
