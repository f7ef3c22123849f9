# expect: pcr fail PCR-3
metadata = {"protocolName": "multiplex PCR, fish panel", "apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    block = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "fins Sept")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, "PCR")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    p = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix = tubes["A1"]
    p.transfer(18, master_mix, plate.wells()[:8])
    p.transfer(2, block.wells()[:8], plate.wells()[:8], mix_after=(2, 10), new_tip="once")
