"""Runs the examples that rules carry: passing ones must pass, failing ones must be caught.

An example is the body of ``run`` on a small fixed deck (see :data:`DECK`), or a whole protocol
if it defines ``run`` itself.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..errors import AegisError
from .checking import check_script
from .judging import Options, Report
from .rehearsal import Script
from .rules import Database, Example, Family, RuleSpec

DECK = """metadata = {"apiLevel": "2.15"}


def run(protocol):
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 3)
    p20 = protocol.load_instrument(
        "p20_single_gen2", "left", [protocol.load_labware("opentrons_96_tiprack_20ul", 4)]
    )
    p300 = protocol.load_instrument(
        "p300_single_gen2", "right", [protocol.load_labware("opentrons_96_tiprack_300ul", 5)]
    )
"""
"""The deck that a bare example body runs on."""


@dataclass(frozen=True)
class ExampleResult:
    """What came of one example.

    Attributes:
        rule: The rule that carries it.
        title: The example's title.
        expected: Whether the rule should find something.
        found: Whether it did.
        problem: Why the example is no good, or ``""``.
    """

    rule: str
    title: str
    expected: bool
    found: bool
    problem: str = ""

    @property
    def ok(self) -> bool:
        """Whether the rule did what its example promises."""
        return not self.problem and self.expected == self.found


def protocol_text(example: Example) -> str:
    """The whole protocol that an example stands for."""
    if any(line.startswith("def run(") for line in example.code):
        return "\n".join(example.code) + "\n"
    return DECK + "".join(f"    {line}\n" for line in example.code)


def run_examples(database: Database, rules: Iterable[str] = ()) -> list[ExampleResult]:
    """Run the examples of the given rules, or of all.

    A passing example must bring no finding of any rule of the family; a failing one must bring
    the rule's own. The family is given, so that short snippets need no title.
    """
    wanted = set(rules)
    results = []
    reports: dict[tuple[str, tuple[str, ...]], Report] = {}
    for family in database.families:
        for rule in family.rules:
            if wanted and rule.id not in wanted:
                continue
            for example in rule.examples.passing:
                results.append(_run(database, reports, family, rule, example, expected=False))
            for example in rule.examples.failing:
                results.append(_run(database, reports, family, rule, example, expected=True))
    return results


def _run(
    database: Database,
    reports: dict[tuple[str, tuple[str, ...]], Report],
    family: Family,
    rule: RuleSpec,
    example: Example,
    expected: bool,
) -> ExampleResult:
    key = (family.family, example.code)
    try:
        if key not in reports:  # rules of one family share their good examples
            reports[key] = _report(database, family, example)
        report = reports[key]
    except AegisError as error:
        return ExampleResult(rule.id, example.title, expected, False, str(error))
    found = [finding.rule for finding in report.findings]
    if not expected:
        others = ", ".join(dict.fromkeys(found))
        problem = f"finds {others}" if found and rule.id not in found else ""
        undecided = next((u.reason for u in report.undecided if u.rule == rule.id), "")
        if undecided:
            problem = f"is undecided: {undecided}"
        return ExampleResult(rule.id, example.title, expected, rule.id in found, problem)
    return ExampleResult(rule.id, example.title, expected, rule.id in found)


def _report(database: Database, family: Family, example: Example) -> Report:
    script = Script(text=protocol_text(example), file_name="example.py")
    return check_script(script, database, Options(assay=(family.family,)))
