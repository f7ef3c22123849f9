"""Waste that comes out again."""

from __future__ import annotations

import textwrap

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


EMPTIED = """
samples, liquid_waste = rack.wells()[:8], rack["{}"]
for tube in samples:
    p.transfer(150, tube, liquid_waste.top(-3))
"""


def test_nothing_is_drawn_from_the_waste_for_a_well() -> None:
    drawn = EMPTIED.format("D6") + "p.transfer(50, rack['D6'], plate['A1'])"
    ((severity, message),) = found(drawn, "GEN-1")
    assert severity == "error"
    assert "8 other wells were emptied into that waste" in message
    away = EMPTIED.format("D6") + "p.transfer(300, rack['D6'], ctx.fixed_trash['A1'])"
    assert not found(away, "GEN-1")
