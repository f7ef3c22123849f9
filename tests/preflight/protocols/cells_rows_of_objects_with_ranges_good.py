# expect: cell_treatment pass
"""Olaparib in three strips of a plate of OVCAR-3, with a vehicle strip on either side."""

from typing import NamedTuple

metadata = {"apiLevel": "2.15", "protocolName": "Olaparib, OVCAR-3"}


class Strip(NamedTuple):
    source: str
    columns: range
    content: str


STRIPS = [
    Strip("A6", range(0, 1), "vehicle"),
    Strip("A1", range(1, 4), "olaparib"),
    Strip("A2", range(4, 7), "olaparib"),
    Strip("A3", range(7, 10), "olaparib"),
    Strip("A6", range(10, 12), "vehicle"),
]


def run(protocol):
    trough = protocol.load_labware("nest_12_reservoir_15ml", 1, "5x")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "OVCAR-3 cells")
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 3)
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    seeded = protocol.define_liquid("OVCAR-3 in medium", "day 1", "#ffaa00")
    for well in cells.wells():
        well.load_liquid(seeded, 100)

    for strip in STRIPS:
        m300.pick_up_tip()
        for column in strip.columns:
            m300.aspirate(25, trough[strip.source])
            m300.dispense(25, cells.rows()[0][column])
        m300.drop_tip()
