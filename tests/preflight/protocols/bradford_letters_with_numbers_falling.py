# expect: bradford fail BRD-1
"""Bradford of muscle extracts.

assay plate, column 1: A blank, B 0.1, C 0.2, D 0.3, E 0.5, F 0.7, G 0.9, H 1.2 mg/ml BSA
columns 2 and 3: extracts
"""

metadata = {"apiLevel": "2.14", "protocolName": "muscle"}


def run(ctx):
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    extracts = ctx.load_labware("nest_96_wellplate_200ul_flat", 6, "muscle extracts")
    assay = ctx.load_labware("corning_96_wellplate_360ul_flat", 5, "assay plate")
    reagent = ctx.load_labware("nest_1_reservoir_195ml", 3, "Bradford reagent")["A1"]
    small = ctx.load_labware("opentrons_96_filtertiprack_20ul", 8)
    large = ctx.load_labware("opentrons_96_filtertiprack_200ul", 9)
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[small])
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[large])

    p20.pick_up_tip()
    for number in reversed(range(8)):
        p20.aspirate(5, tubes.wells()[number])
        p20.dispense(5, assay.columns()[0][number])
    p20.drop_tip()
    for source, target in zip(extracts.wells()[:16], assay.wells()[8:24]):
        p20.transfer(5, source, target)
    for column in assay.columns()[:3]:
        m300.transfer(195, reagent, column[0], new_tip="always", mix_after=(3, 100))
