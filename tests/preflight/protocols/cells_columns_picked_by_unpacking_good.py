# expect: cell_treatment pass
metadata = {"protocolName": "Macrophages and LPS", "apiLevel": "2.13"}
ARMS = {"vehicle": ("A1", 3), "drug low": ("A2", 4), "drug high": ("A3", 5)}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "macrophages")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    for arm, (tube, number) in ARMS.items():
        for letter in "BCDE":
            pip.transfer(10, tubes[tube], plate[f"{letter}{number}"], new_tip="always")
    pip.transfer(10, tubes["A1"], plate["F3"])
