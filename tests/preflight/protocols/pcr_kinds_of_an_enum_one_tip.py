from enum import Enum
from types import SimpleNamespace
from typing import NamedTuple

metadata = {"protocolName": "qPCR plate", "apiLevel": "2.15"}


class Kind(str, Enum):
    SAMPLE = "sample"
    NTC = "ntc"


class Rxn(NamedTuple):
    kind: Kind
    tube: object
    well: object


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (1, 4)]
    rack = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    reagents = SimpleNamespace(mastermix=rack["D6"], water=rack["D5"])
    rxns = [Rxn(Kind.SAMPLE, rack.wells()[i], plate.wells()[i]) for i in range(7)]
    rxns.append(Rxn(Kind.NTC, rack["D5"], plate["H1"]))
    for r in rxns:
        p20.transfer(15, reagents.mastermix, r.well)
    p20.pick_up_tip()
    for r in rxns:
        p20.aspirate(5, r.tube)
        p20.dispense(5, r.well)
        p20.mix(2, 10, r.well)
    p20.drop_tip()
