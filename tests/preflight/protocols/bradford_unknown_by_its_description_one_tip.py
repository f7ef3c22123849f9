# expect: bradford fail BRD-2
metadata = {"protocolName": "Bradford, antibody fragments", "apiLevel": "2.14"}


def run(ctx):
    rack = ctx.load_labware(
        "opentrons_24_tuberack_nest_1.5ml_snapcap", 1, "BSA standards and Fabs"
    )
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2)
    trough = ctx.load_labware("nest_1_reservoir_195ml", 3, "Bradford reagent")
    t20 = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    t300 = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    for number, level in enumerate((0, 0.25, 0.5, 1, 1.5, 2)):
        bsa = ctx.define_liquid(f"{level} mg/ml", "standard", "#0000ff")
        rack.rows()[0][number].load_liquid(bsa, 200)
    fab = ctx.define_liquid("Fab", "unknown", "#ff0000")
    for tube in rack.rows()[1]:
        tube.load_liquid(fab, 100)

    p20.transfer(5, [rack["A1"], rack["B1"]], [plate["A1"], plate["A2"]])
    for column, row in enumerate(rack.rows()[:2]):
        p20.transfer(5, row[1:], plate.columns()[column][1:6], new_tip="always")
    for well in plate.columns()[0][:6] + plate.columns()[1][:6]:
        p300.transfer(245, trough["A1"], well, mix_after=(3, 120))
