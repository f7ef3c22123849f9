# expect: pcr pass PCR-5!
metadata = {"protocolName": "Carbapenemase qPCR", "apiLevel": "2.13"}


def run(ctx):
    mixes = "qPCR mixes A1 KPC, A2 NDM"
    block = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 1, mixes)
    swabs = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "rectal swab DNA")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, "qPCR plate")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    for n, spot in enumerate(("A1", "A2")):
        wells = plate.columns()[n][:6]
        p20.transfer(15, block[spot], wells, new_tip="always")
        for source, well in zip(swabs.columns()[0], wells):
            p20.transfer(5, source, well)
