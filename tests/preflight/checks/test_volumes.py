"""Volumes that a pause leaves open: someone may have emptied or filled a well by hand."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import Report, Script, check_script, load_rules

PROTOCOL = """
metadata = {{"apiLevel": "2.15"}}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    trough = ctx.load_labware("nest_12_reservoir_15ml", 2)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    p300.transfer(300, trough["A1"], plate["A1"])
    {meanwhile}
    p300.transfer({volume}, trough["A1"], plate["A1"])
"""


def _check(meanwhile: str, volume: float) -> tuple[set[str], str]:
    text = PROTOCOL.format(meanwhile=meanwhile, volume=volume)
    report: Report = check_script(Script(text, "fill.py"), load_rules())
    undecided = {undecided.rule: undecided.reason for undecided in report.undecided}
    return {finding.rule for finding in report.findings}, undecided.get("GEN-3", "")


@pytest.mark.parametrize("message", ["", "Incubate 10 min", "Go on?", "Fill up the plate"])
def test_a_pause_that_does_not_say_what_is_done_leaves_it_open(message: str) -> None:
    assert "GEN-3" not in _check(f"ctx.pause('{message}')", 100)[0]


def test_what_fits_anyway_leaves_nothing_open() -> None:
    assert _check("ctx.pause('Go on?')", 60) == (set(), "")


@pytest.mark.parametrize(
    "meanwhile",
    [
        "ctx.delay(minutes=10)",
        "ctx.pause('Put on fresh gloves')",
        "ctx.pause('Remove the lid of the plate')",
        "ctx.pause('Replace the tips')",
    ],
)
def test_what_changes_no_volume_leaves_nothing_open(meanwhile: str) -> None:
    assert "GEN-3" in _check(meanwhile, 100)[0]
