# expect: generic pass
"""Buffer from a strip plate, columns 1 to 3 hold the same, into nine columns from above."""

metadata = {"protocolName": "Aliquots", "apiLevel": "2.13"}


def run(ctx):
    strips = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1)
    goal = ctx.load_labware("nest_96_wellplate_200ul_flat", 2)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])

    m300.pick_up_tip()
    for number in range(9):
        m300.aspirate(30, strips.rows()[0][number // 3])
        m300.dispense(30, goal.rows()[0][number].top())
    m300.drop_tip()
