# expect: bradford warn BRD-2
metadata = {"apiLevel": "2.14", "protocolName": "Bradford, sixteen lysates"}


def run(ctx):
    tips20 = ctx.load_labware("opentrons_96_tiprack_20ul", 7)
    tips300 = ctx.load_labware("opentrons_96_tiprack_300ul", 10)
    src = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    assay = ctx.load_labware("corning_96_wellplate_360ul_flat", 2)
    trough = ctx.load_labware("nest_1_reservoir_195ml", 3, "Bradford reagent")
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[tips20])
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[tips300])
    # lysates columns 2 and 3 of the source plate, standards column 1
    cols = assay.rows()[0]
    m20.pick_up_tip()
    for source, dest in zip(src.rows()[0][:3], cols):
        m20.aspirate(5, source)
        m20.dispense(5, dest)
    m20.drop_tip()
    for dest in cols[:3]:
        m300.transfer(250, trough["A1"], dest, mix_after=(3, 150), new_tip="always")
