"""One target in two columns, by mistake with two volumes."""

from collections import namedtuple

metadata = {"protocolName": "PCR set-up", "apiLevel": "2.13"}
Target = namedtuple("Target", "name mix_tube column volume")
TARGETS = [Target("16S", "A1", 0, 15), Target("16S", "A1", 1, 18)]


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    templates = rack.rows()[1][:4]
    water = rack["D6"]
    for target in TARGETS:
        *reactions, ntc = plate.columns()[target.column][:5]
        p20.pick_up_tip()
        for well in [*reactions, ntc]:
            p20.aspirate(target.volume, rack[target.mix_tube])
            p20.dispense(target.volume, well)
        p20.drop_tip()
        p20.transfer(2, water, ntc)
        p20.transfer(2, templates, reactions, new_tip="always")
