# expect: generic pass
metadata = {"apiLevel": "2.15", "protocolName": "Dilute lysates from above"}
# reservoir: 1-3 = bicarbonate buffer, three troughs of one batch
BUFFER = ["A1", "A2", "A3"]


def run(ctx):
    lysates = ctx.load_labware("nest_96_wellplate_2ml_deep", 1, "protein lysates")
    res = ctx.load_labware("nest_12_reservoir_15ml", 3, "reagents")
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 5)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    columns = lysates.rows()[0]

    def rain(troughs, volume):
        m300.pick_up_tip()
        for i, column in enumerate(columns):
            src = res[troughs[i * len(troughs) // len(columns)]]
            m300.aspirate(volume, src)
            m300.dispense(volume, column.top(1))
        m300.drop_tip()

    rain(BUFFER, 250)
