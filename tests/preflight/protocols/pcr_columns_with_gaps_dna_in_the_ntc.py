# expect: pcr warn PCR-4
"""Colony PCR in every other column, so that the seal can be cut.

plate columns 1,3,5 = samples, 7 = NTC
"""

metadata = {"apiLevel": "2.14"}


def run(ctx):
    tips20 = ctx.load_labware("opentrons_96_filtertiprack_20ul", 7)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[tips20])
    pcr_plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    colonies = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2)
    reservoir = ctx.load_labware("nest_12_reservoir_15ml", 3)
    master_mix, water = reservoir["A1"], reservoir["A12"]

    m20.pick_up_tip()
    for column in "1357":
        m20.aspirate(18, master_mix)
        m20.dispense(18, pcr_plate[f"A{column}"])
    m20.drop_tip()
    for k, column in enumerate("1357", 1):
        m20.transfer(2, colonies[f"A{k}"], pcr_plate[f"A{column}"])
