# plate
#
#      1   2   3   4   5
#  A  S1  S2  S3  POS NTC    <- gene 1
#  B  S1  S2  S3  POS NTC    <- gene 2
metadata = {"apiLevel": "2.14", "protocolName": "RT-qPCR, two genes"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    block = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 1)
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    mixes = {"A": block["A1"], "B": block["B1"]}  # master mixes
    rna = [block[spot] for spot in ("A3", "A4", "A5")]
    ivt = block["B4"]  # positive control RNA
    water = block["D1"]
    for row, mix in mixes.items():
        p20.transfer(12, mix, plate.rows_by_name()[row][:5], new_tip="once")
    for row in "AB":
        p20.transfer(8, water, plate[row + "5"], mix_after=(2, 8))
        for n, tube in enumerate([*rna, ivt, ivt], 1):
            p20.transfer(8, tube, plate[row + str(n)], mix_after=(2, 8))
