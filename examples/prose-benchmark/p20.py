"""Sex of parrot chicks."""

metadata = {"protocolName": "CHD PCR", "apiLevel": "2.13"}


def run(ctx):
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "PCR plate")
    block = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 3)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix = block["A1"]
    goals = plate.rows()[0][:6]  # tubes row A: DNA 1-5, A6 H2O

    p20.transfer(16, master_mix, goals, new_tip="always")
    for number in range(6):
        p20.transfer(4, tubes.rows()[0][number], goals[number])
