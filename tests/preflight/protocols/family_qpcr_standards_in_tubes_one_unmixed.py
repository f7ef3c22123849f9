# expect: serial_dilution fail SD-1
metadata = {
    "protocolName": "qPCR standard curve, gBlock",
    "description": "1e7 copies down to 10, in tubes, for the freezer",
    "apiLevel": "2.13",
}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1, "qPCR standards")
    t200 = ctx.load_labware("opentrons_96_filtertiprack_200ul", 2)
    t20 = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[t200])
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[t20])

    te_buffer = rack["D6"]
    curve = rack.rows()[0] + rack.rows()[1][:1]

    p300.transfer(180, te_buffer, curve[1:], new_tip="once")
    for upper, lower in zip(curve, curve[1:]):
        p20.pick_up_tip()
        p20.transfer(20, upper, lower, mix_after=(8, 20) if lower is not curve[3] else None, new_tip="never")
        p20.drop_tip()
