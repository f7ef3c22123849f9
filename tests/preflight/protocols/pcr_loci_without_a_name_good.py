# expect: pcr pass
from opentrons import protocol_api

metadata = {"protocolName": "Genotyping, 4 loci", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (4, 5, 6)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)

    mastermix, water = tubes["A1"], tubes["A6"]
    loci = tubes.rows()[1][:4]          # Rs123, Rs220, Rs9, Rs44
    dnas = tubes.rows()[2][:5]
    ntc = plate.columns()[5][:4]
    used = [w for c in plate.columns()[:6] for w in c[:4]]
    p20.transfer(6, mastermix, used, new_tip="once")
    for locus, row in zip(loci, plate.rows()):
        p20.transfer(2, locus, row[:6], new_tip="once")
    for dna, col in zip(dnas, plate.columns()):
        p20.transfer(2, dna, col[:4], new_tip="always")
    p20.transfer(2, water, ntc, new_tip="once")
