# expect: bradford fail BRD-1
# 16 plasma samples in duplicate + BSA standards in duplicate (cols 11-12)
metadata = {"apiLevel": "2.14", "protocolName": "Bradford, plasma"}


def run(ctx):
    standards = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1, "BSA")
    plasma = ctx.load_labware("nest_96_wellplate_200ul_flat", 2, "plasma")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3, "Bradford plate")
    dye = ctx.load_labware("nest_12_reservoir_15ml", 6, "Bradford reagent").wells()[0]
    small = ctx.load_labware("opentrons_96_filtertiprack_20ul", 8)
    large = ctx.load_labware("opentrons_96_filtertiprack_200ul", 9)
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[small])
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[large])

    curve = {0: "A1", 50: "A2", 100: "A3", 200: "A4", 400: "A5", 800: "A6"}
    p20.pick_up_tip()
    for (conc, tube), row in zip(reversed(curve.items()), plate.rows()):
        for well in row[10:]:
            p20.aspirate(5, standards[tube])
            p20.dispense(5, well)
    p20.drop_tip()
    for number, source in enumerate(plasma.wells()[:16]):
        row, first = plate.rows()[number % 8], 2 * (number // 8)
        p20.transfer(5, source, row[first : first + 2], new_tip="once")
    for column in (0, 1, 2, 3, 10, 11):
        m300.transfer(195, dye, plate.columns()[column][0], new_tip="always", mix_after=(3, 90))
