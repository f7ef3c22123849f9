# expect: bradford fail BRD-2
"""Bradford of tear fluid with QC samples."""

metadata = {"apiLevel": "2.13"}
QC = {"C1": "QC low", "C2": "QC high"}


def run(ctx):
    t20 = ctx.load_labware("opentrons_96_tiprack_20ul", 1)
    t300 = ctx.load_labware("opentrons_96_tiprack_300ul", 2)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4)
    dye = ctx.load_labware("nest_1_reservoir_195ml", 5, "Coomassie reagent")["A1"]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    standards = rack.rows()[0][:5]  # 0, 0.125, 0.25, 0.5, 1 mg/ml
    p20.pick_up_tip()
    for tube, well in zip(standards, plate.columns()[0]):
        p20.transfer(5, tube, well, new_tip="never")
    p20.drop_tip()
    p20.pick_up_tip()
    p20.transfer(5, rack["C1"], plate["A3"], new_tip="never")
    p20.transfer(5, rack["C2"], plate["B3"], new_tip="never")
    p20.drop_tip()
    for well in plate.columns()[0][:5] + plate.columns()[2][:2]:
        p300.transfer(250, dye, well, mix_after=(3, 150), new_tip="always")
