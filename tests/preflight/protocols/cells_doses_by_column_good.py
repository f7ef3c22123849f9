# expect: cell_treatment pass
"""Bortezomib on MM.1S, one plate. Doses in uM, made before in the troughs of the same number."""

metadata = {"apiLevel": "2.13"}

DOSE_OF_COLUMN = {3: 0.04, 4: 0.2, 5: 1, 6: 5}
VEHICLE_COLUMN = 2


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "MM.1S cells")
    bortezomib = ctx.load_labware("nest_12_reservoir_15ml", 2, "bortezomib")
    dmso = ctx.load_labware("nest_1_reservoir_195ml", 4, "DMSO vehicle")["A1"]
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])

    m20.transfer(10, dmso, plate.columns()[VEHICLE_COLUMN - 1][0])
    m20.pick_up_tip()
    for column in sorted(DOSE_OF_COLUMN):
        m20.aspirate(10, bortezomib.wells()[column - 1])
        m20.dispense(10, plate.columns()[column - 1][0])
    m20.drop_tip()
