# expect: pcr pass PCR-4!
"""Chytrid survey: skin swabs of frogs."""

metadata = {"protocolName": "Bd qPCR", "apiLevel": "2.13"}

PLAN = {
    "frog 1": ("A1", "A1"),
    "frog 2": ("A2", "B1"),
    "frog 3": ("A3", "C1"),
    "NTC": ("D6", "H12"),
}


def run(ctx):
    swabs = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    block = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix = block["A1"]

    for name, (tube, well) in PLAN.items():
        p20.transfer(16, master_mix, plate[well], new_tip="always")
    for name, (tube, well) in PLAN.items():
        ctx.comment(f"{name}: 4 uL")
        p20.transfer(4, swabs[tube], plate[well], new_tip="always")
