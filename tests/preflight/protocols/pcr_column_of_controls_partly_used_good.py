# expect: pcr pass
metadata = {"apiLevel": "2.13", "protocolName": "qPCR, two assays"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "qPCR plate")
    block = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 1)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mixes = [block["A1"], block["B1"]]
    water = block["D1"]
    rna = [block[spot] for spot in ("A3", "A4", "A5")]
    ntc_column = plate.columns()[3]
    for mix, well in zip(master_mixes, ntc_column):
        p20.transfer(12, mix, well)
        p20.transfer(8, water, well, mix_after=(2, 8))
    for column, tube in zip(plate.columns(), rna):
        for number, mix in enumerate(master_mixes):
            for well in column[2 * number : 2 * number + 2]:
                p20.transfer(12, mix, well)
                p20.transfer(8, tube, well, mix_after=(2, 8))
