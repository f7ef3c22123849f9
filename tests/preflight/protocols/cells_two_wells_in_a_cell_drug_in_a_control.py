# expect: cell_treatment fail CELL-1 CELL-2?
metadata = {"protocolName": "Trypanosomes", "apiLevel": "2.13"}
STEPS = [
    ["A1", "C4 C5", "vehicle"],
    ["A2", "D4 D5", "vehicle"],
    ["A2", "E4 E5", "compound 1 uM"],
    ["A2", "F4 F5", "compound 1 uM"],
    ["A3", "E6 E7", "compound 5 uM"],
    ["A3", "F6 F7", "compound 5 uM"],
]


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 3)
    stocks = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "parasite culture")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    for tube, wells, _ in STEPS:
        for name in wells.split():
            pip.transfer(20, stocks[tube], plate[name], new_tip="always")
