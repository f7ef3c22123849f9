# expect: serial_dilution fail SD-3
metadata = {"protocolName": "dye two-fold dilution series", "apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    res = ctx.load_labware("nest_12_reservoir_15ml", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3)
    p = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    a, b = res["A1"], res["A12"]
    cols = [plate.columns_by_name()[str(n)][0] for n in range(1, 12)]
    p.transfer(100, a, cols[1:-2], new_tip="once")
    p.transfer(200, b, cols[0])
    for k in range(10):
        p.transfer(100, cols[k], cols[k + 1], mix_after=(3, 90), new_tip="always")
