# expect: generic pass GEN-1!
"""Two replica plates get 25 % glycerol, each out of a channel of its own."""

metadata = {"apiLevel": "2.15"}


def run(ctx):
    replicas = [ctx.load_labware("nest_96_wellplate_200ul_flat", s, f"replica {s}") for s in (2, 3)]
    reservoir = ctx.load_labware("nest_12_reservoir_15ml", 4, "25 % glycerol")
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 7)
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[tips])
    glycerol = [reservoir["A1"], reservoir["A2"]]
    m300.pick_up_tip()
    for channel, replica in zip(glycerol, replicas):
        for column in replica.columns():
            m300.aspirate(40, channel)
            m300.dispense(40, column[0])
    m300.drop_tip()
