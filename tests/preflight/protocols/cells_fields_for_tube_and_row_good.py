# expect: cell_treatment pass
"""Staurosporine on HeLa cells (slot 1); tubes in slot 2."""
from dataclasses import dataclass

metadata = {"apiLevel": "2.15", "protocolName": "Staurosporine"}


@dataclass
class Arm:
    name: str
    tube: str
    row: str


DOSES = [Arm("1 uM", "A1", "A"), Arm("10 uM", "A2", "B")]
VEHICLE = Arm("DMSO vehicle", "A4", "D")


def run(protocol):
    plate = protocol.load_labware("corning_24_wellplate_3.4ml_flat", 1, "HeLa cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "10x drug")
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    def treat(arm):
        for column in range(1, 7):
            p300.aspirate(100, rack[arm.tube])
            p300.dispense(100, plate[f"{arm.row}{column}"])

    for arm in [*DOSES, VEHICLE]:
        p300.pick_up_tip()
        treat(arm)
        p300.drop_tip()
