"""The file of examples beside a rule file, and what is told of examples that break their word."""

from __future__ import annotations

import dataclasses
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from aegis_ot.errors import RuleError
from aegis_ot.preflight import RuleSet, load_rules
from aegis_ot.preflight.rule_set import load_family
from aegis_ot.preflight.rules import Example
from aegis_ot.workbench.rule_example_files import examples_of
from aegis_ot.workbench.rule_examples import protocol_text, run_examples

OWN = Path(__file__).parents[2] / "examples" / "rules" / "luciferase.json"


@pytest.fixture
def beside(tmp_path: Path) -> Callable[[str], RuleSet]:
    """The rules of one family with this text in the file of examples beside it."""

    def write(text: str) -> RuleSet:
        shutil.copy(OWN, tmp_path / "mine.json")
        (tmp_path / "mine.examples.py").write_text(text, encoding="utf-8")
        family = load_family(tmp_path / "mine.json")
        return RuleSet((family,), load_rules().common)

    return write


def test_every_shipped_rule_has_four_of_each() -> None:
    for family in load_rules().families:
        # Handling needs no names and roles, which the others' examples vary.
        least = 1 if family.family == "handling" else 4
        for rule, examples in examples_of(family).items():
            assert len(examples.passing) >= least, rule
            assert len(examples.failing) >= least, rule
            titles = [example.title for example in (*examples.passing, *examples.failing)]
            assert len(set(titles)) == len(titles), rule


def test_a_deck_stands_before_what_follows_it_up_to_the_next(
    beside: Callable[[str], RuleSet],
) -> None:
    rule_set = beside(
        '"""What it is."""\n\n# deck\na = tubes["A1"]\n\n'
        "# LUC-1, LUC-2 passes: one\np20.transfer(1, a, a)\n\n\n"
        "# deck\nb = 1\n# LUC-2, LUC-1 warns: two\n\n# a comment\np20.home()\n"
    )
    inline = {rule.id: rule.examples for rule in rule_set.families[0].rules}
    examples = examples_of(rule_set.families[0])
    passing = examples["LUC-1"].passing[-1]
    assert passing == examples["LUC-2"].passing[-1]
    assert passing.code == ('a = tubes["A1"]', "p20.transfer(1, a, a)")
    failing = examples["LUC-2"].failing[-1]
    assert failing == Example(
        "two", ("b = 1", "# a comment", "p20.home()"), also=("LUC-1",), severity="warning"
    )
    assert examples["LUC-1"].failing == inline["LUC-1"].failing
    assert examples["LUC-1"].passing[:-1] == inline["LUC-1"].passing


@pytest.mark.parametrize(
    ("heading", "words"),
    [
        ("# PCR-1 passes: not of this family", "line 2: there is no rule PCR-1 there"),
        ("# LUC-1 succeeds: well", "line 2: a snippet passes, fails or warns"),
    ],
)
def test_a_wrong_heading_is_told_with_its_line(
    heading: str, words: str, beside: Callable[[str], RuleSet]
) -> None:
    with pytest.raises(RuleError, match=f"mine.examples.py, {words}"):
        examples_of(beside(f"\n{heading}\n").families[0])


def test_only_what_a_snippet_uses_is_loaded() -> None:
    text = protocol_text(Example("", ('plate = protocol.load_labware("x", 9)', "p20.home()")))
    assert 'tips20 = protocol.load_labware("opentrons_96_tiprack_20ul"' in text
    assert "p20_single_gen2" in text
    assert text.count("plate = ") == 1
    assert "p300" not in text
    assert "m20" not in text


OVERFULL = 'for _ in range(2):\n    p300.transfer(250, tubes["A1"], plate["A1"])\n'
FULL = 'p300.transfer(200, tubes["A1"], plate["A1"])\n'


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        (f"# GEN-3 passes: a\n{FULL}# GEN-3 fails: b\n{OVERFULL}", ""),
        (
            f"# GEN-3 passes: a\n{FULL}# GEN-3 warns: b\n{OVERFULL}",
            "is told as error, not as warning",
        ),
        (f"# GEN-3 passes: a\n{FULL}", "needs a passing and a failing one"),
        (f"# GEN-3 passes: a\n{OVERFULL}# GEN-3 fails: b\n{OVERFULL}", "finds"),
        (f"# GEN-3 passes: a\n{FULL}# GEN-3 fails: b\n{FULL}", "nothing"),
        (f"# GEN-3 passes: a\n{FULL}# GEN-3 fails: b\n{OVERFULL}# GEN-3 fails: c\n1 / 0\n", "Zero"),
    ],
    ids=["sound", "severity", "none fails", "passing fires", "failing is silent", "raises"],
)
def test_an_example_that_breaks_its_word_is_told(text: str, problem: str, tmp_path: Path) -> None:
    (tmp_path / "generic.examples.py").write_text(text, encoding="utf-8")
    shipped = next(family for family in load_rules().families if family.family == "generic")
    generic = dataclasses.replace(
        shipped,
        path=str(tmp_path / "generic.json"),
        rules=tuple(rule for rule in shipped.rules if rule.id == "GEN-3"),
    )
    rule_set = RuleSet((generic,), load_rules().common)
    bad = [result for result in run_examples(rule_set) if not result.ok]
    if not problem:
        assert bad == []
        return
    (result,) = bad
    told = result.problem or ("finds" if result.found else "nothing")
    assert problem in told
