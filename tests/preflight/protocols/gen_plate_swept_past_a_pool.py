"""Wells of a plate are rinsed one into the next; a part of each, but not the rest, goes into a pool."""

metadata = {"apiLevel": "2.13", "protocolName": "Sample pooling"}


def run(ctx):
    m300 = ctx.load_instrument(
        "p300_multi_gen2", "left", tip_racks=[ctx.load_labware("opentrons_96_tiprack_300ul", 4)]
    )
    samp_cols = ctx.load_labware("nest_96_wellplate_200ul_flat", 1, "sample plate").rows()[0][:4]
    pool = ctx.load_labware("nest_12_reservoir_15ml", 2)["A12"]
    kept = ctx.load_labware("nest_96_wellplate_200ul_flat", 3, "destination plate")["A1"]
    m300.pick_up_tip()
    m300.mix(5, 100, samp_cols[0])
    m300.aspirate(100, samp_cols[0])
    m300.dispense(20, pool)
    m300.dispense(80, samp_cols[1])
    for column in (1, 2):
        m300.mix(5, 100, samp_cols[column])
        m300.aspirate(100, samp_cols[column])
        m300.dispense(20, pool)
        m300.dispense(80, samp_cols[column + 1])
    m300.mix(5, 100, samp_cols[3])
    m300.aspirate(150, samp_cols[3])
    m300.dispense(150, kept)
    m300.drop_tip()
