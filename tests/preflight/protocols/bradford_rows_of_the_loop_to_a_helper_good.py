# expect: bradford pass
"""Bradford with the eight-channel pipette, everything in duplicate columns."""

# deep well (slot 4)
#   col 1: A blank, B 50, C 100, D 200, E 400, F 600, G 800, H 1000 ug/ml BSA
#   col 2: samples 1-8    col 3: samples 9-16
metadata = {"apiLevel": "2.14", "protocolName": "sixteen extracts"}
BSA, FIRST, SECOND = "1", "2", "3"
BSA_TO, FIRST_TO, SECOND_TO = ["1", "2", "3"], ["5", "6", "7"], ["9", "10", "11"]


def run(ctx):
    deep = ctx.load_labware("nest_96_wellplate_2ml_deep", 4, "curve, samples")
    flat = ctx.load_labware("corning_96_wellplate_360ul_flat", 5, "read plate")
    reagent = ctx.load_labware("nest_1_reservoir_195ml", 6, "Bradford reagent")["A1"]
    small = ctx.load_labware("opentrons_96_filtertiprack_20ul", 8)
    large = ctx.load_labware("opentrons_96_filtertiprack_200ul", 9)
    m20 = ctx.load_instrument("p20_multi_gen2", "right", tip_racks=[small])
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[large])

    def head(labware, col):
        return labware.columns_by_name()[col][0]

    for source, columns in [(BSA, BSA_TO), (FIRST, FIRST_TO), (SECOND, SECOND_TO)]:
        m20.pick_up_tip()
        for col in columns:
            m20.aspirate(5, head(deep, source))
            m20.dispense(5, head(flat, col))
        m20.drop_tip()
    tops = [head(flat, col).top() for col in BSA_TO + FIRST_TO + SECOND_TO]
    m300.transfer(195, reagent, tops, new_tip="once")
    for columns in (BSA_TO, FIRST_TO, SECOND_TO):
        m300.pick_up_tip()
        for col in columns:
            m300.mix(4, 120, head(flat, col))
        m300.drop_tip()
