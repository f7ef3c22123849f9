# expect: cell_treatment pass
metadata = {"protocolName": "Library screen on yeast", "apiLevel": "2.13"}
LIBRARY = {"A1": "compound CPD-007", "B1": "compound CPD-113", "C1": "compound CPD-042"}
VEHICLE_WELLS = ["H1", "H2", "H3"]


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    source = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "library")
    yeast = ctx.load_labware("corning_96_wellplate_360ul_flat", 3, "yeast cells")
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    vehicle = source["H12"]
    for name in VEHICLE_WELLS:
        p20.transfer(2, vehicle, yeast[name], new_tip="always")
    for spot, name in zip(("C1", "B1", "A1"), ("A1", "B1", "C1")):
        p20.pick_up_tip()
        for well in yeast.rows_by_name()[name[0]][:3]:
            p20.transfer(2, source[spot], well, new_tip="never")
        p20.drop_tip()
