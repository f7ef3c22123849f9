# expect: pcr pass
# genotype stamp: KASP mix of each assay into its plate, then the lysates stamped, NTC in H12
metadata = {"apiLevel": "2.13"}


def run(ctx):
    source = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "crude lysates")
    plates = [ctx.load_labware("biorad_96_wellplate_200ul_pcr", slot) for slot in (2, 3)]
    trough = ctx.load_labware("nest_12_reservoir_15ml", 5, "KASP mixes")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 6)
    boxes = [ctx.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (4, 7, 9)]
    single = ctx.load_labware("opentrons_96_filtertiprack_20ul", 8)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=boxes)
    s20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[single])
    water = rack["A1"]
    for number, dest in enumerate(plates):
        ntc = dest["H12"]
        mix = trough.wells()[number]
        m20.transfer(8, mix, dest.rows()[0][:10], new_tip="once")
        s20.transfer(8, mix, ntc)
        s20.transfer(2, water, ntc)
        m20.transfer(2, source.rows()[0][:10], dest.rows()[0][:10], new_tip="always")
