"""Runs the examples that rules carry: passing ones must pass, failing ones must be caught.

An example is the body of ``run`` on a small fixed deck (see :data:`DECK`), or a whole protocol
if it defines ``run`` itself. A rule file holds examples itself, or has a file of them beside it:
``pcr.json``, ``pcr.examples.py``; see :mod:`.rule_example_files`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ..errors import AegisError
from ..preflight import Options, Report, RuleSet, Script, check_script
from ..preflight.rules import Example, Family, RuleSpec
from ..vocabulary import Finding, Severity
from .rule_example_files import examples_of

HEAD = 'metadata = {"apiLevel": "2.15"}\n\n\ndef run(protocol):\n'

DECK = {
    "plate": 'protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1)',
    "tubes": 'protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)',
    "reservoir": 'protocol.load_labware("nest_12_reservoir_15ml", 3)',
    "tips20": 'protocol.load_labware("opentrons_96_tiprack_20ul", 4)',
    "tips300": 'protocol.load_labware("opentrons_96_tiprack_300ul", 5)',
    "strips": 'protocol.load_labware("biorad_96_wellplate_200ul_pcr", 6)',
    "culture": 'protocol.load_labware("corning_96_wellplate_360ul_flat", 7)',
    "deepwell": 'protocol.load_labware("nest_96_wellplate_2ml_deep", 8)',
    "p20": 'protocol.load_instrument("p20_single_gen2", "left", [tips20])',
    "m20": 'protocol.load_instrument("p20_multi_gen2", "left", [tips20])',
    "p300": 'protocol.load_instrument("p300_single_gen2", "right", [tips300])',
    "m300": 'protocol.load_instrument("p300_multi_gen2", "right", [tips300])',
}
"""What stands on the deck of an example body that uses it, by name."""


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
    body = [*_deck(example.code), *example.code]
    return HEAD + "".join(f"    {line}\n" for line in body)


def _deck(code: Iterable[str]) -> Iterator[str]:
    """The lines that load what this code uses and does not load itself."""
    text = "\n".join(code)
    used = {name for name in DECK if re.search(rf"(?<![\w.\"']){name}\b(?!\s*=[^=])", text)}
    used |= {tips for n in used for tips in ("tips20", "tips300") if f"[{tips}]" in DECK[n]}
    for name, load in DECK.items():
        if name in used and not re.search(rf"^{name} = ", text, re.M):
            yield f"{name} = {load}"


def run_examples(rule_set: RuleSet, rules: Iterable[str] = ()) -> list[ExampleResult]:
    """Run the examples of the given rules, or of all.

    A passing example must bring no finding of any rule of the family, and leave the rule decided;
    a failing one must bring the rule's own, and no other than it names. A rule must have both. The
    family is given, so that short snippets need no title.

    Raises:
        RuleError: A file of examples cannot be used.
    """
    wanted = set(rules)
    results = []
    reports: dict[tuple[str, tuple[str, ...]], Report] = {}
    for family in rule_set.families:
        carried = examples_of(family)
        for rule in family.rules:
            if wanted and rule.id not in wanted:
                continue
            examples = carried[rule.id]
            for example in examples.passing:
                results.append(_run(rule_set, reports, family, rule, example, expected=False))
            for example in examples.failing:
                results.append(_run(rule_set, reports, family, rule, example, expected=True))
            if not (examples.passing and examples.failing):
                none = "a passing and a failing one at least"
                results.append(ExampleResult(rule.id, "its examples", True, False, f"needs {none}"))
    return results


def _run(
    rule_set: RuleSet,
    reports: dict[tuple[str, tuple[str, ...]], Report],
    family: Family,
    rule: RuleSpec,
    example: Example,
    expected: bool,
) -> ExampleResult:
    key = (family.family, example.code)
    try:
        if key not in reports:  # rules of one family share examples
            reports[key] = _report(rule_set, family, example)
        report = reports[key]
    except AegisError as error:
        return ExampleResult(rule.id, example.title, expected, False, str(error))
    own = [finding for finding in report.findings if finding.rule == rule.id]
    problem = ""
    others = {finding.rule for finding in report.findings} - {rule.id, *example.also}
    if expected:  # rules of other families that hold everywhere may well find something as well
        others &= {rule.id for rule in family.rules}
    undecided = next((u.reason for u in report.undecided if u.rule == rule.id), "")
    if undecided:
        problem = f"is undecided: {undecided}"
    elif others:
        problem = f"finds {', '.join(sorted(others))}"
    elif expected and own and example.severity not in ("any", _worst(own)):
        problem = f"is told as {_worst(own)}, not as {example.severity}"
    return ExampleResult(rule.id, example.title, expected, bool(own), problem)


def _worst(findings: Iterable[Finding]) -> str:
    if any(finding.severity is Severity.ERROR for finding in findings):
        return "error"
    return "warning"


def _report(rule_set: RuleSet, family: Family, example: Example) -> Report:
    script = Script(text=protocol_text(example), file_name="example.py")
    return check_script(script, rule_set, Options(assay=(family.family,)))
