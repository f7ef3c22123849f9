# expect: serial_dilution pass
"""Two inhibitors for an IC50, 1:3 in DMSO, eight points each; the last column is DMSO only."""

metadata = {"apiLevel": "2.15"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "Intermediate plate")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "10 mM stocks")
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", slot) for slot in (5, 6)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    dmso = rack["D1"]
    inhibitors = {"A": rack["A1"], "E": rack["A2"]}
    dmso_only = [plate["A12"], plate["E12"]]
    points = {row: [plate[f"{row}{n}"] for n in range(1, 9)] for row in inhibitors}
    p20.pick_up_tip()
    for well in [*points["A"][1:], *points["E"][1:], *dmso_only]:
        p20.transfer(20, dmso, well, new_tip="never")
    p20.drop_tip()
    for row, inhibitor in inhibitors.items():
        p20.transfer(30, inhibitor, points[row][0], new_tip="always")
        p20.transfer(10, points[row][:-1], points[row][1:], mix_after=(5, 15), new_tip="always")
