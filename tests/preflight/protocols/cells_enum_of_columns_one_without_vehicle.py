# expect: cell_treatment fail CELL-2
from enum import Enum, auto

metadata = {"apiLevel": "2.14"}


class Arm(Enum):
    UNTREATED = auto()
    VEHICLE = auto()
    DRUG_LOW = auto()
    DRUG_HIGH = auto()


COLUMNS = {2: Arm.UNTREATED, 3: Arm.VEHICLE, 4: Arm.DRUG_LOW, 5: Arm.DRUG_HIGH, 6: Arm.VEHICLE}
TUBES = {Arm.VEHICLE: "A1", Arm.DRUG_LOW: "B1", Arm.DRUG_HIGH: "C1"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5, "drug and vehicle")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "Vero cells")
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    for arm, spot in TUBES.items():
        p20.pick_up_tip()
        for well in [plate[r + str(c)] for c, a in COLUMNS.items() if a is arm for r in "BCDEFG"]:
            p20.aspirate(10, rack[spot])
            p20.dispense(10, plate["B6"] if well is plate["C6"] else well)
        p20.drop_tip()
