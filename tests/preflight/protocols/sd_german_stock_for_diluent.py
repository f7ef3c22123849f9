# expect: serial_dilution fail SD-4
metadata = {"protocolName": "Verdünnungsreihe Lysozym", "apiLevel": "2.13"}


def run(ctx):
    spitzen = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    rinne = ctx.load_labware("nest_12_reservoir_15ml", 2)
    platte = ctx.load_labware("corning_96_wellplate_360ul_flat", 3)
    p = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[spitzen])
    verduennungspuffer = rinne["A1"]
    stammloesung = rinne["A2"]
    reihe = platte.rows()[0][:8]
    p.transfer(100, stammloesung, reihe[1:])
    p.transfer(200, stammloesung, reihe[0])
    for von, nach in zip(reihe, reihe[1:]):
        p.transfer(100, von, nach, mix_after=(4, 80), new_tip="always")
