# expect: pcr pass
"""qPCR."""
from opentrons import protocol_api
metadata = {"apiLevel": "2.14"}
NTC = slice(12, 15)
CDNA = slice(0, 12)


def run(ctx: protocol_api.ProtocolContext):
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    mm, water = tubes["A1"], tubes["A2"]
    for w in plate.wells()[:15]:
        p20.transfer(15, mm, w, new_tip="always")
    for cdna, w in zip(tubes.wells()[8:20], plate.wells()[CDNA]):
        p20.transfer(5, cdna, w, new_tip="always")
    for w in plate.wells()[NTC]:
        p20.transfer(5, water, w, new_tip="always")
