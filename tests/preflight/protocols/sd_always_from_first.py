# expect: serial_dilution fail SD-2
metadata = {"apiLevel": "2.13", "protocolName": "MIC broth microdilution"}


def run(ctx):
    t = ctx.load_labware("opentrons_96_tiprack_300ul", 4)
    p = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[t])
    plate = ctx.load_labware("nest_96_wellplate_200ul_flat", 1)
    res = ctx.load_labware("nest_12_reservoir_15ml", 2)
    MHB, ampicillin = res["A1"], res["A2"]
    wells = plate.rows()[0]
    p.distribute(100, MHB, wells[1:11])
    p.transfer(190, ampicillin, wells[0])
    for i in range(9):
        p.pick_up_tip()
        p.aspirate(100, wells[0])
        p.dispense(100, wells[i + 1])
        p.mix(3, 80, wells[i + 1])
        p.drop_tip()
    p.pick_up_tip()
    p.aspirate(100, wells[9])
    p.dispense(100, ctx.fixed_trash["A1"])
    p.drop_tip()
