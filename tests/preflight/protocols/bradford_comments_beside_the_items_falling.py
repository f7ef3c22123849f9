# expect: bradford fail BRD-1
metadata = {"apiLevel": "2.13"}

ORDER = [
    "A1",  # blank, 0.1 M NaOH
    "A2",  # BSA 125 ug/mL
    "A3",  # BSA 500 ug/mL
    "A4",  # BSA 2000 ug/mL
]


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    bradford_reagent = ctx.load_labware("nest_12_reservoir_15ml", 4)["A1"]
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", 3)
    big = ctx.load_labware("opentrons_96_tiprack_300ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[big])
    p20.pick_up_tip()
    for n, spot in reversed(list(enumerate(ORDER))):
        p20.aspirate(10, rack[spot])
        p20.dispense(10, plate.wells()[n])
    p20.drop_tip()
    for n in range(4):
        p300.transfer(200, bradford_reagent, plate.wells()[n], mix_after=(3, 100))
