"""Protocols on which recoveries are tried: ways in which wells are filled, and what may not mix."""

from __future__ import annotations

from dataclasses import dataclass

_HEAD = """
metadata = {"apiLevel": "2.16"}
def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "plate")
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2, "reservoir")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4, "tubes")
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (3, 6)]
    p300 = protocol.load_instrument("p300_single_gen2", "left", tips)

    def liquid(name, well, volume):
        well.load_liquid(protocol.define_liquid(name, name, "#ff0000"), volume)
"""


@dataclass(frozen=True)
class Case:
    """One protocol.

    Attributes:
        name: What it does.
        assay: Family of rules that judges it.
        body: Of its ``run``.
        wells: Destinations in which a fault may be planted.
    """

    name: str
    assay: str
    body: str
    wells: tuple[str, ...]

    @property
    def text(self) -> str:
        """The whole protocol."""
        return _HEAD + self.body


LATER = tuple(f"{row}2" for row in "ABCDEFGH")
"""The second column: Layer 2 has seen six and more deliveries of the same liquid by then."""

CASES = (
    Case(
        "dye with fresh tips into empty wells",
        "bradford",
        """
    dye = reservoir["A1"]
    liquid("dye reagent", dye, 12000)
    for well in plate.wells()[:16]:
        p300.transfer(150, dye, well, new_tip="always")
""",
        LATER,
    ),
    Case(
        "PCR: master mix with one tip, then templates and water for the NTC",
        "pcr",
        """
    master_mix, water = reservoir["A1"], reservoir["A2"]
    liquid("master mix", master_mix, 12000)
    liquid("water", water, 12000)
    templates = tubes.wells()[:15]
    for number, well in enumerate(templates):
        liquid(f"template {number}", well, 1000)
    reactions = plate.wells()[:16]
    ntc = plate["H2"]
    p300.transfer(100, master_mix, reactions, new_tip="once")
    for template, well in zip(templates, reactions):
        p300.transfer(60, template, well, new_tip="always")
    p300.transfer(60, water, ntc, new_tip="always")
""",
        LATER,
    ),
    Case(
        "serial dilution, mixed, with a fresh tip each",
        "serial_dilution",
        """
    series = plate.columns()[0] + plate.columns()[1]
    liquid("stock", series[0], 200)
    for well in series[1:]:
        liquid("diluent", well, 100)
    for before, after in zip(series, series[1:]):
        p300.transfer(100, before, after, mix_after=(3, 50), new_tip="always")
""",
        LATER,
    ),
    Case(
        "a drug from above onto cells, with one tip",
        "cell_treatment",
        """
    drug = tubes["A1"]
    liquid("drug", drug, 1400)
    cells = plate.wells()[:16]
    for well in cells:
        liquid("cells in medium", well, 100)
    p300.transfer(80, drug, [well.top() for well in cells], new_tip="once")
""",
        LATER,
    ),
)
