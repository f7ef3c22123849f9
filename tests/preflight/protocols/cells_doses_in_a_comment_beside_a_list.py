# expect: cell_treatment pass
metadata = {"apiLevel": "2.13", "protocolName": "Etoposide, HeLa"}

# 0.1 uM, 1 uM, 10 uM, vehicle (DMSO)
SOURCE = [1, 2, 3, 4]
TARGET = [2, 3, 4, 6]


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", 7)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    tenfold = ctx.load_labware("nest_96_wellplate_2ml_deep", 1, "etoposide 10x (1-3), vehicle (4)")
    hela = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "HeLa cells 90 ul")
    sources = [tenfold["A%d" % c] for c in SOURCE]
    treated = [hela["A%d" % c] for c in TARGET]
    m20.transfer(10, sources[3], treated[3])
    m20.pick_up_tip()
    for n in range(3):
        m20.transfer(10, sources[n], treated[n], new_tip="never")
    m20.drop_tip()
