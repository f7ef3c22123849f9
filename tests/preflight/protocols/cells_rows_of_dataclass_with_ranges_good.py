# expect: cell_treatment pass
"""Olaparib and vehicle in blocks of three columns."""

from dataclasses import dataclass

metadata = {"apiLevel": "2.15", "protocolName": "Olaparib, OVCAR-3"}


@dataclass
class Block:
    columns: range
    arm: str
    trough: str


BLOCKS = [
    Block(range(0, 3), "vehicle", "A8"),
    Block(range(3, 6), "olaparib", "A1"),
    Block(range(6, 9), "olaparib", "A2"),
    Block(range(9, 12), "vehicle", "A8"),
]


def run(protocol):
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 1)
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "OVCAR-3 cells")
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 3)
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    medium = protocol.define_liquid("medium with 0.1 % DMSO", "vehicle", "#ffffff")
    olaparib = protocol.define_liquid("olaparib", "5x", "#00ff00")
    reservoir["A8"].load_liquid(medium, 9000)
    for name in ("A1", "A2"):
        reservoir[name].load_liquid(olaparib, 9000)

    for block in BLOCKS:
        m300.pick_up_tip()
        for column in block.columns:
            m300.aspirate(25, reservoir[block.trough])
            m300.dispense(25, cells.rows()[0][column])
        m300.drop_tip()
