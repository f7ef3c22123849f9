# expect: cell_treatment pass CELL-1!
"""Trametinib on melanoma cells; every well gets 6 uL, drug and solvent together."""

metadata = {"protocolName": "Trametinib, back-filled", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "melanoma cells")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    solvent, drug = rack["A1"], rack["A2"]
    vehicle_wells = plate.columns()[10][:3]

    for well in vehicle_wells:
        p20.transfer(6, solvent, well)
    for number, ul in enumerate((1, 2, 4)):
        for well in plate.columns()[number][:3]:
            ctx.comment(f"{well.well_name}: {6 - ul} uL DMSO, then drug")
            p20.transfer(6 - ul, solvent, well)
            p20.transfer(ul, drug, well)
