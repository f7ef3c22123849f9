# expect: pcr fail PCR-4
from typing import NamedTuple

metadata = {"protocolName": "Plasmid screen, 5 colonies", "apiLevel": "2.13"}


class Reaction(NamedTuple):
    position: str
    template_tube: str
    remark: str


COLONIES = [
    Reaction("A1", "B1", "colony 1"),
    Reaction("A2", "B2", "colony 2"),
    Reaction("A3", "B3", "colony 3"),
    Reaction("A4", "B4", "colony 4"),
    Reaction("A5", "B5", "colony 5"),
]
NO_TEMPLATE = Reaction("A6", "B5", "water only")
READY_MIX = "D1"


def run(ctx):
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "1")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", "2")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", "3")
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    reactions = [NO_TEMPLATE, *COLONIES]
    p20.pick_up_tip()
    for reaction in reactions:
        p20.transfer(18, tubes[READY_MIX], plate[reaction.position], new_tip="never")
    p20.drop_tip()
    for reaction in reactions:
        p20.transfer(2, tubes[reaction.template_tube], plate[reaction.position], mix_after=(3, 10))
