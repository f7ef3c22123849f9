# expect: cell_treatment fail CELL-4
"""Dose response on fibroblasts, a column of the compound plate for two columns of cells."""

from dataclasses import dataclass
from typing import Sequence, Tuple

metadata = {"protocolName": "TGF-b inhibitor titration", "apiLevel": "2.15"}


@dataclass(frozen=True)
class Arm:
    final_nm: float
    from_column: int
    onto: Tuple[int, ...]


ARMS: Sequence[Arm] = (
    Arm(500.0, 1, (2, 3)),
    Arm(50.0, 2, (4, 5)),
    Arm(5.0, 3, (6, 7)),
)
VEHICLE_COLUMN = 11


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    drugs = protocol.load_labware("nest_96_wellplate_200ul_flat", 2, "inhibitor plate")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "cell plate")
    p20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    inhibitor = protocol.define_liquid("Inhibitor (10x)", "in assay medium", "#aa0000")
    vehicle = protocol.define_liquid("Vehicle", "0.1 % DMSO in assay medium", "#00aa00")
    fibroblasts = protocol.define_liquid("Cells", "fibroblasts in 90 uL medium", "#0000aa")
    for arm in ARMS:
        for well in drugs.columns()[arm.from_column - 1]:
            well.load_liquid(inhibitor, 80)
    for well in drugs.columns()[VEHICLE_COLUMN - 1]:
        well.load_liquid(vehicle, 80)
    for column in cells.columns()[1:7] + [cells.columns()[10]]:
        for well in column:
            well.load_liquid(fibroblasts, 90)

    p20.transfer(10, drugs["A11"], cells["A11"])
    p20.pick_up_tip()
    for arm in ARMS:
        for column in arm.onto:
            p20.aspirate(10, drugs.columns()[arm.from_column - 1][0])
            p20.dispense(10, cells.columns()[column - 1][0])
    p20.drop_tip()
