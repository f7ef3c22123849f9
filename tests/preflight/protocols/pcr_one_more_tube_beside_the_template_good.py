# expect: pcr pass
metadata = {"protocolName": "Hookworm ITS2", "apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    block = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, water, template = block["A1"], block["A2"], block["C1"]
    ntc = plate["H1"]
    for well in [*plate.columns()[0][:6], ntc]:
        p20.transfer(15, master_mix, well, new_tip="always")
    for well in plate.columns()[0][:3]:
        p20.transfer(5, template, well, new_tip="always")
    for well in plate.columns()[0][3:6]:
        p20.transfer(5, block["C2"], well, new_tip="always")
    p20.transfer(5, water, ntc)
