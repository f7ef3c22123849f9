# expect: cell_treatment fail CELL-1 CELL-2
"""Stamp with an 8-channel. Compound plate A1-H12: one compound a well, 2 mM in DMSO."""

metadata = {"protocolName": "Stamp onto U2OS", "apiLevel": "2.10"}


def run(ctx):
    library = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 4, "compounds")
    u2os = ctx.load_labware("corning_96_wellplate_360ul_flat", 5, "U2OS")
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (7, 8)]
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=tips)

    dmso = library["A12"]
    vehicle_controls = u2os.columns()[10]

    def stamp(src, dst):
        m20.pick_up_tip()
        m20.aspirate(2, src)
        m20.dispense(2, dst)
        m20.drop_tip()

    for number in range(1, 10):
        stamp(library.rows()[0][number], u2os.rows()[0][number])
    stamp(library["A11"], vehicle_controls[0])
