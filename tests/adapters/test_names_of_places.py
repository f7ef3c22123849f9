"""Names of places in wells count only where no other name holds the well, and run no code."""

from __future__ import annotations

from aegis_ot.preflight import Script, check_script, load_rules

PROTOCOL = """
from opentrons.types import Location

metadata = {{"apiLevel": "2.13"}}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix = rack["A1"]
    templates = [rack["B1"], rack["B2"], rack["B3"]]
    {water}
    wells = plate.wells()[:3]
    ntc = plate["H1"]
    for well in [*wells, ntc]:
        p20.transfer(15, master_mix, well, new_tip="always")
    for tube, well in zip([*templates, {tube}], [*wells, ntc]):
        sample_position = tube.bottom(1) if hasattr(tube, "bottom") else tube
        p20.transfer(5, sample_position, well, new_tip="always")
"""


def _rules(water: str, tube: str) -> set[str]:
    text = PROTOCOL.format(water=water, tube=tube)
    return {finding.rule for finding in check_script(Script(text, "p.py"), load_rules()).findings}


def test_the_name_of_a_place_in_a_loop_does_not_rename_a_named_tube() -> None:
    assert _rules('water = rack["D6"]', "water") == set()


def test_a_place_is_named_where_nothing_else_names_its_well() -> None:
    assert _rules('water = rack["D6"].bottom(1)', "water") == set()
    assert "PCR-4" in _rules('last_template = rack["B3"].bottom(1)', "last_template")


def test_a_location_of_the_protocols_own_making_is_not_opened() -> None:
    own = """
    class Loud(Location):
        @property
        def labware(self):
            raise RuntimeError("opened")
    quiet = Loud(rack["D6"].bottom(1).point, None)
    water = rack["D6"]"""
    assert _rules(own, "water") == set()
