# expect: cell_treatment pass
metadata = {"protocolName": "Chondrocytes, interleukin", "apiLevel": "2.13"}


def run(ctx):
    # cells: column 2 vehicle, columns 3-6 inhibitor
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "chondrocyte cells")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    vehicle, inhibitor = tubes["D1"], tubes["D2"]
    for row in cells.rows()[:7]:
        pip.transfer(15, vehicle, row[1], new_tip="always")
    for row in cells.rows()[:7]:
        for well in row[2:6]:
            pip.transfer(15, inhibitor, well, new_tip="always")
