# expect: generic pass
metadata = {"protocolName": "top up", "apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = ctx.load_labware("corning_24_wellplate_3.4ml_flat", 2, "HeLa")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    for well in plate.columns()[0]:
        p300.transfer(50, tubes["A1"], well, mix_after=(2, 150), new_tip="always")
