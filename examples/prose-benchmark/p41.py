metadata = {"protocolName": "Protein in honey, dye binding", "apiLevel": "2.13"}

# gamma globulin standards in the tube rack:
#   pos     A1    A2    A3    A4    A5
#   ug/ml   1500  750   300   100   0
# honey B1 to B4


def run(ctx):
    t20 = ctx.load_labware("opentrons_96_tiprack_20ul", 1)
    t300 = ctx.load_labware("opentrons_96_tiprack_300ul", 2)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4)
    bradford = ctx.load_labware("nest_1_reservoir_195ml", 5)["A1"]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    p20.pick_up_tip()
    for n in (4, 3, 2, 1, 0):
        p20.transfer(5, rack.rows()[0][n], plate.rows()[0][n], new_tip="never")
    p20.drop_tip()
    for n in range(4):
        p20.transfer(5, rack.rows()[1][n], plate.rows()[1][n])
    for well in plate.rows()[0][:5] + plate.rows()[1][:4]:
        p300.transfer(250, bradford, well, mix_after=(3, 150), new_tip="always")
