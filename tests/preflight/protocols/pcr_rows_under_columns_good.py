# expect: pcr pass PCR-4!
"""HPV 16, cervical swabs in A1-D1.

Controls in columns 10-12: row A/B positive, row D/E NTC
"""

metadata = {"protocolName": "HPV qPCR", "apiLevel": "2.13"}


def run(ctx):
    swabs = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 1, "swab DNA")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, "qPCR plate")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, plasmid, water = tubes["A1"], tubes["A2"], tubes["A3"]
    women = plate.columns()[0][:4]
    controls = plate.columns()[9:]

    for well in women + [c[n] for c in controls for n in (0, 1, 3, 4)]:
        p20.transfer(16, master_mix, well)
    p20.transfer(4, swabs.columns()[0][:4], women, new_tip="always")
    for column in controls:
        p20.transfer(4, plasmid, column[:2], new_tip="always")
        p20.transfer(4, water, column[3:5], new_tip="always")
