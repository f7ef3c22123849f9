# expect: bradford pass
metadata = {"protocolName": "Coomassie assay of whey", "apiLevel": "2.13"}
LEVELS = ["blank", "0.1 mg/mL", "0.4 mg/mL", "0.8 mg/mL", "2 mg/mL"]


def run(ctx):
    t20 = ctx.load_labware("opentrons_96_tiprack_20ul", 1)
    t300 = ctx.load_labware("opentrons_96_tiprack_300ul", 2)
    vials = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4)
    dye = ctx.load_labware("nest_1_reservoir_195ml", 5)["A1"]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    bsa = vials.wells()[: len(LEVELS)]
    p20.pick_up_tip()
    for tube, well in zip(bsa, plate.wells()):
        p20.transfer(5, tube, well, new_tip="never")
    p20.drop_tip()
    for whey, well in zip(vials.rows()[3], plate.columns()[1]):
        p20.transfer(5, whey, well)
    for well in plate.wells()[:5] + plate.columns()[1][:6]:
        p300.transfer(250, dye, well, mix_after=(3, 150), new_tip="always")
