# expect: cell_treatment pass
"""TNF in three doses, each row of the table given whole to a helper."""

metadata = {"apiLevel": "2.13", "protocolName": "TNF on fibroblasts"}

ROWS = {
    # TNF, ng/ml: (wells of the plate, tube)
    2: (["A2", "B2"], "C1"),
    10: (["A3", "B3"], "C2"),
    50: (["A4", "B4"], "C3"),
}
VEHICLE = (["A1", "B1"], "C6")  # PBS


def run(ctx):
    plate = ctx.load_labware("corning_24_wellplate_3.4ml_flat", 1, "fibroblasts")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4, "TNF dilutions")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[tips])

    def treat(wells, tube):
        for name in wells:
            p300.aspirate(50, rack[tube])
            p300.dispense(50, plate[name])

    p300.pick_up_tip()
    treat(*VEHICLE)
    for dose in (2, 10, 50):
        treat(*ROWS[dose])
    p300.drop_tip()
