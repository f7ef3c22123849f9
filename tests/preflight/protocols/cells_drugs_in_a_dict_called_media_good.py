# expect: cell_treatment pass
from opentrons import protocol_api

metadata = {"protocolName": "Media in a dict", "apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "cell plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    res = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tips = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (4, 5)]
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=tips)

    """A549 cells. Ready-made media with 1 uM gefitinib or with DMSO."""
    media = {"DMSO": res["A1"], "gefitinib": res["A2"], "plain": res["A3"]}
    dmso_wells, gefitinib_wells, untreated = plate.columns()[0], plate.columns()[1], plate.columns()[2]
    for name, wells in (("plain", untreated), ("DMSO", dmso_wells), ("gefitinib", gefitinib_wells)):
        m300.transfer(100, media[name], wells[0])
