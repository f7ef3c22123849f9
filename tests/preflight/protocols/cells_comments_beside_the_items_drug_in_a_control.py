# expect: cell_treatment warn CELL-1
metadata = {"apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "HeLa cells, 24 h")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    tubes = [
        rack["A1"],  # vehicle (0.5 % DMSO)
        rack["A2"],  # staurosporine, 0.1 uM
        rack["A3"],  # staurosporine, 1 uM
        rack["A4"],  # staurosporine, 10 uM
    ]
    COLUMNS = [
        1,  # vehicle control
        2,  # staurosporine 0.1 uM
        3,  # staurosporine 1 uM
        4,  # staurosporine 10 uM
    ]
    for tube, column in zip(tubes, COLUMNS):
        p20.pick_up_tip()
        for row in "ABCDEFGH":
            p20.aspirate(5, tube)
            p20.dispense(5, plate[f"{row}{column}"])
        p20.drop_tip()
    p20.transfer(5, tubes[3], plate["H1"])
