metadata = {"protocolName": "antibody titration serial dilution", "apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    res = ctx.load_labware("nest_12_reservoir_15ml", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3)
    p = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    diluent, mab = res["A1"], res["A2"]
    s = plate.rows()[2]
    p.transfer(200, mab, s[0])
    for x, y in zip(s[:5], s[1:6]):
        p.transfer(100, x, y, mix_after=(3, 50), new_tip="always")
    p.transfer(100, diluent, s[1:6], new_tip="once", mix_after=(3, 50))
