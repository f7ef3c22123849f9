metadata = {"apiLevel": "2.13", "protocolName": "Plate to plate plate_2"}


def run(ctx):
    t = ctx.load_labware("opentrons_96_tiprack_300ul", 4)
    m = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[t])
    plate_1 = ctx.load_labware("nest_96_wellplate_200ul_flat", 1)
    plate_2 = ctx.load_labware("nest_96_wellplate_200ul_flat", 2)
    m.transfer(50, plate_1.rows()[0], plate_2.rows()[0], new_tip="once")
