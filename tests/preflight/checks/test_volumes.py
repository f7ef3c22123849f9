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


RESERVOIR = """
metadata = {{"apiLevel": "2.15"}}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    res = ctx.load_labware("nest_96_wellplate_2ml_deep", 2, "Reservoir")
    tubes = ctx.load_labware("opentrons_15_tuberack_nest_15ml_conical", 4)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    p300.transfer({given}, tubes["A1"], res["A1"].top(), new_tip="once")
    {mix}
    p300.transfer({volume}, res["A1"], plate.columns()[0], new_tip="once")
"""
MIX = "p300.pick_up_tip()\n    p300.mix(1, 300, res['A1'])\n    p300.drop_tip()"


@pytest.mark.parametrize(
    ("given", "volume", "mix", "wrong"),
    [
        (250, 75, "", True),
        (600, 75, "", False),
        (500, 75, "", True),  # one draw lacks a little
        (250, 75, MIX, False),  # it held more than the run gave it
    ],
)
def test_what_the_run_hands_out_it_has_put_there(
    given: int, volume: int, mix: str, wrong: bool
) -> None:
    text = RESERVOIR.format(given=given, volume=volume, mix=mix)
    report: Report = check_script(Script(text, "fill.py"), load_rules())
    assert bool([one for one in report.findings if one.rule == "GEN-3"]) is wrong
