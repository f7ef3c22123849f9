# expect: bradford fail BRD-1
"""Lowry assay. Albumin curve: tube, ug/ml, row of the plate."""

metadata = {"apiLevel": "2.13"}
CURVE = [("C6", 800, "A"), ("C5", 400, "B"), ("C4", 200, "C"), ("C3", 0, "D")]


def run(protocol):
    small = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 4)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    folin = protocol.load_labware("nest_12_reservoir_15ml", 5)["A1"]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[large])

    def spot(standard, row, column):
        p20.aspirate(10, rack[standard])
        p20.dispense(10, plate[f"{row}{column}"])

    for column in (1, 2):
        p20.pick_up_tip()
        for tube, conc, row in CURVE:
            spot(tube, row, column)
        p20.drop_tip()
    p300.transfer(150, folin, plate.rows()[0][:2], mix_after=(3, 100), new_tip="always")
