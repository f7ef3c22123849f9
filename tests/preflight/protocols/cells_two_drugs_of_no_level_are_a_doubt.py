# expect: cell_treatment pass
"""A549 and two drugs from unlabelled tubes. Vehicle in column 1, treated in columns 2-7."""

metadata = {"protocolName": "A549, two drugs", "apiLevel": "2.13"}


def run(ctx):
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "A549")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    vehicle = tubes["D6"]

    for well in plate.columns()[0]:
        p20.transfer(8, vehicle, well, new_tip="always")
    p20.pick_up_tip()
    for tube, columns in ((tubes["A1"], (1, 2, 3)), (tubes["B1"], (4, 5, 6))):
        for number in columns:
            for well in plate.columns()[number]:
                p20.transfer(8, tube, well, new_tip="never")
    p20.drop_tip()
