# expect: pcr pass PCR-4!
"""Timber under CITES: five kinds of sawdust, onto dried qPCR mixes. Plate H1-H3: NTC."""

metadata = {"protocolName": "rbcL, matK and ITS PCR", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "PCR plate, mixes dried down")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    water = rack["A2"]

    for column in plate.columns()[:3]:
        p20.transfer(20, water, column[7])
        for tube, well in zip(rack.rows()[1][:5], column):
            p20.transfer(20, tube, well)
