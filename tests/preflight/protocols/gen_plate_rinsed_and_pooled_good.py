# expect: generic pass
"""Each column is rinsed with what rinsed the one before it, and a part goes to the pool."""

metadata = {"apiLevel": "2.13", "protocolName": "Barcoded islets, pooling"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = ctx.load_labware("nest_96_wellplate_2ml_deep", 2)
    trough = ctx.load_labware("nest_12_reservoir_15ml", 3)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    rinse, overlay, pool = trough["A1"], trough["A2"], trough["A12"]
    cols = plate.rows()[0][:8]
    m300.pick_up_tip()
    for col in cols:
        m300.aspirate(300, overlay)
        m300.dispense(300, col.top())
    m300.drop_tip()
    for _ in range(3):
        m300.pick_up_tip()
        m300.aspirate(100, rinse)
        m300.dispense(100, cols[0])
        for one, other in zip(cols, cols[1:]):
            m300.mix(5, 120, one)
            m300.aspirate(150, one)
            m300.dispense(50, pool)
            m300.dispense(100, other)
        m300.aspirate(150, cols[-1])
        m300.dispense(150, pool)
        m300.drop_tip()
