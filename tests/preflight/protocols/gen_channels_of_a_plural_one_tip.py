# expect: generic fail GEN-1
"""Two replica plates get a secondary antibody, each out of a channel of its own."""

metadata = {"apiLevel": "2.15"}


def run(ctx):
    replicas = [ctx.load_labware("nest_96_wellplate_200ul_flat", s, f"replica {s}") for s in (2, 3)]
    reservoir = ctx.load_labware("nest_12_reservoir_15ml", 4, "antibodies")
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 7)
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[tips])
    antibodies = [reservoir["A1"], reservoir["A2"]]
    m300.pick_up_tip()
    for channel, replica in zip(antibodies, replicas):
        for column in replica.columns():
            m300.aspirate(40, channel)
            m300.dispense(40, column[0])
    m300.drop_tip()
