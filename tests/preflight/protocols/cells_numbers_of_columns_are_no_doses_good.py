# expect: cell_treatment pass
metadata = {"protocolName": "Astrocytes", "apiLevel": "2.13"}
ARMS = {"vehicle": ("A1", 9), "drug lot 1": ("A2", 8), "drug lot 2": ("A3", 7)}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "astrocytes")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    pip.pick_up_tip()
    for arm, (tube, number) in ARMS.items():
        for letter in "BCDE":
            pip.transfer(10, tubes[tube], plate[f"{letter}{number}"], new_tip="never")
    pip.drop_tip()
