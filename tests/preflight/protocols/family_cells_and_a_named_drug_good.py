# expect: cell_treatment pass
metadata = {"protocolName": "TNF on HUVEC", "apiLevel": "2.13"}


def run(ctx):
    huvec = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "HUVEC")
    strip = ctx.load_labware("nest_12_reservoir_15ml", 2)
    box = ctx.load_labware("opentrons_96_filtertiprack_200ul", 4)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[box])
    veh, tnf = strip["A1"], strip["A2"]
    vehicle_control = huvec["A1"]
    m300.transfer(20, veh, vehicle_control)
    for column in range(2, 6):
        m300.transfer(20, tnf, huvec[f"A{column}"], mix_after=(2, 50))
