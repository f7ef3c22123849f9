from dataclasses import dataclass
from enum import Enum, auto

metadata = {"protocolName": "Inhibitors on HT-29 cells", "apiLevel": "2.15"}


class Kind(Enum):
    TREATED = auto()
    VEHICLE_CONTROL = auto()


@dataclass(frozen=True)
class Reagent:
    name: str
    kind: Kind


class Arm:
    __slots__ = ("reagent", "tube", "column", "fresh")

    def __init__(self, reagent, tube, column, fresh=True):
        self.reagent, self.tube, self.column, self.fresh = reagent, tube, column, fresh


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    block = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "HT-29 cells")
    p = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    arms = [
        Arm(Reagent("AZ-1775", Kind.TREATED), block["A1"], plate.columns()[0]),
        Arm(Reagent("GDC-0994", Kind.TREATED), block["A2"], plate.columns()[1]),
        Arm(Reagent("0.1 %", Kind.VEHICLE_CONTROL), block["A3"], plate.columns()[2], False),
    ]
    for arm in arms:
        if arm.fresh:
            if p.has_tip:
                p.drop_tip()
            p.pick_up_tip()
        for well in arm.column:
            p.aspirate(10, arm.tube)
            p.dispense(10, well)
    p.drop_tip()
