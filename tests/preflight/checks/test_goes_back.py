"""Blanks that are none, and sources that a tip goes back to which mixed what is made of them."""

from __future__ import annotations

import textwrap

import pytest

from aegis_ot.preflight import Report, Script, check_script, load_rules

DECK = """
metadata = {"apiLevel": "2.15", "protocolName": "%s"}

def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 4, "cell samples")
    bottle = ctx.load_labware("opentrons_6_tuberack_nest_50ml_conical", 5, "PBS")
    pool = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "pool")["A1"]
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 6)
    p = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
"""


def found(code: str, rule: str, name: str = "Transfer") -> list[tuple[str, str]]:
    text = DECK % name + textwrap.indent(textwrap.dedent(code).strip("\n"), "    ")
    report: Report = check_script(Script(text, "p.py"), load_rules())
    return [(one.severity.value, one.message) for one in report.findings if one.rule == rule]


HALVES = """
for library in (libraries := plate.columns()[0]):
    p.pick_up_tip()
    for _ in range(2):
        p.transfer(20, library, pool, new_tip="never"{})
    p.drop_tip()
"""


def test_a_tip_that_mixed_the_pool_does_not_go_back_into_a_library() -> None:
    ((severity, message),) = found(HALVES.format(", mix_after=(3, 20)"), "GEN-1")
    assert severity == "warning"
    assert "what is left of it is not clean" in message
    assert not found(HALVES.format(""), "GEN-1"), "the pool is only given to"


BLANKS = """
standards = [rack[name] for name in ("A1", "B1", "C1")]
buffer, dye = rack["D6"], bottle["A1"]
blank = plate["A1"]
{own}
for tube, well in zip(standards, plate.columns()[0][{first}:]):
    p.transfer(10, tube, well)
for well in plate.columns()[0][:4]:
    p.transfer(200, dye, well, mix_after=(2, 100))
"""
OWN = "p.transfer(10, buffer, blank)"


@pytest.mark.parametrize(
    ("first", "own", "wrong"), [(0, OWN, True), (1, OWN, False), (0, "", False)]
)
def test_no_standard_goes_into_a_blank_that_has_a_liquid_of_its_own(
    first: int, own: str, wrong: bool
) -> None:
    told = found(BLANKS.format(first=first, own=own), "BRD-1", "Bradford")
    assert bool(told) is wrong
