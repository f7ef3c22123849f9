# expect: pcr pass
metadata = {"protocolName": "Lichen barcoding", "apiLevel": "2.13"}
# tubes B1..B6, C1 gDNA
# tube D6 master mix, tube D5 water
# plate: column 1 lichens, H1 NTC


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    tubes = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    for well in plate.columns()[0]:
        p20.transfer(15, tubes["D6"], well, new_tip="always")
    for start, well in zip(tubes.rows()[1] + [tubes["C1"]], plate.wells()):
        p20.transfer(5, start, well, new_tip="always")
    p20.transfer(5, tubes["D5"], plate["H1"])
