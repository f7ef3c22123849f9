metadata = {"apiLevel": "2.13", "protocolName": "Two-fold dilution of a calibrator"}
REAGENTS = {"A1": "assay diluent", "A2": "wash buffer"}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "calibrator curve")
    trough = ctx.load_labware("nest_12_reservoir_15ml", 2, "reagents")
    tips = [ctx.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (3, 6)]
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=tips)
    columns = plate.rows()[0]
    # the calibrator stands in column 1, 200 ul
    # diluent to columns 2-12
    m300.pick_up_tip()
    for n, column in enumerate(columns[1:]):
        m300.aspirate(100, trough.wells()[n // 11])
        m300.dispense(100, column)
    m300.drop_tip()
    for one, other in zip(columns, columns[1:]):
        m300.transfer(100, one, other, mix_after=(5, 80), new_tip="always")
