"""Protein of krill extracts; a tube and its well have one name."""

metadata = {"protocolName": "Bradford of krill", "apiLevel": "2.13"}

BSA_MG_ML = {0.0: "A1", 0.05: "A2", 0.15: "A3", 0.45: "A4", 1.35: "A5"}


def run(ctx):
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2)
    coomassie = ctx.load_labware("nest_1_reservoir_195ml", 3, "Coomassie reagent")["A1"]
    small = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    large = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[large])
    samples = ["C1", "C2", "C3"]

    p20.pick_up_tip()
    for level in sorted(BSA_MG_ML, reverse=True):
        spot = BSA_MG_ML[level]
        p20.transfer(6, tubes[spot], plate[spot], new_tip="never")
    p20.drop_tip()
    for spot in samples:
        p20.transfer(6, tubes[spot], plate[spot])
    for spot in [*BSA_MG_ML.values(), *samples]:
        p300.transfer(180, coomassie, plate[spot], mix_after=(3, 90), new_tip="always")
