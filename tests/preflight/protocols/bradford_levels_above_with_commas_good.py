# expect: bradford pass
"""Proteinbestimmung nach Bradford, die BSA-Reihe mit Dezimalkommas."""

metadata = {"apiLevel": "2.14", "protocolName": "Proteinbestimmung nach Bradford"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    reagent = ctx.load_labware("nest_1_reservoir_195ml", 3, "Bradford reagent")["A1"]
    small = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    large = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[large])

    # 0 / 0,25 / 0,5 / 1,0 / 1,5 mg/ml BSA
    standards = [rack[name] for name in ("A1", "B1", "C1", "D1", "A2")]
    samples = rack.rows()[3][2:]

    p20.pick_up_tip()
    for number in (0, 1, 2, 3, 4):
        p20.aspirate(5, standards[number])
        p20.dispense(5, plate.rows()[0][number])
    p20.drop_tip()
    for tube, well in zip(samples, plate.rows()[1]):
        p20.transfer(5, tube, well)
    for well in plate.rows()[0][:5] + plate.rows()[1][: len(samples)]:
        p300.transfer(195, reagent, well, new_tip="always", mix_after=(3, 100))
