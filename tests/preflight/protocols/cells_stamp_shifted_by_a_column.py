# expect: cell_treatment warn CELL-1 CELL-2?
metadata = {"apiLevel": "2.15", "protocolName": "Stamp of inhibitors onto U2OS"}


def run(ctx):
    # inhibitor plate: columns 1-10 inhibitors at 5 uM in medium, columns 11-12 DMSO vehicle
    # assay plate: same layout; vehicle controls = columns 11, 12
    source = ctx.load_labware("nest_96_wellplate_2ml_deep", 1, "inhibitor plate")
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "U2OS cells")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 3)
    p300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    for n in range(11):
        p300.transfer(20, source.columns()[n], cells.columns()[n + 1], new_tip="always")
