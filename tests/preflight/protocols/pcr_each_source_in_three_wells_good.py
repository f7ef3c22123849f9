# expect: pcr pass
metadata = {"protocolName": "Oyster OsHV-1 qPCR", "apiLevel": "2.13"}


def run(ctx):
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (1, 2)]
    block = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    master_mix, water = block["A1"], block["D6"]
    ntc = plate.columns()[11][:3]
    oysters = [block["B1"], block["B2"], block["B3"], block["B4"]]
    for well in [w for row in plate.rows()[:4] for w in row[:3]] + ntc:
        p20.transfer(15, master_mix, well, new_tip="always")
    for number, oyster in enumerate(oysters):
        for well in plate.rows()[number][:3]:
            p20.transfer(5, oyster, well, new_tip="always")
    for source, well in zip([water, water, water], ntc):
        p20.transfer(5, source, well, new_tip="always")
