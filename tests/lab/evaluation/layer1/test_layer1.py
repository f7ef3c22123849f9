from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from aegis_ot.errors import DatasetError
from aegis_ot.vocabulary import Finding, Severity, Site, WellRef
from aegis_ot_lab.evaluation.layer1 import (
    Checking,
    Label,
    Layer1Result,
    Prediction,
    evaluate_layer1,
    read_labels,
    score_predictions,
)
from aegis_ot_lab.evaluation.layer1.evaluate import cite

FAMILIES = ("pcr", "serial_dilution")
RULES = ("PCR-1", "PCR-2", "PCR-6", "SD-5")


def finding(rule: str, *places: tuple[int, str]) -> Finding:
    sites = tuple(Site(line, WellRef("k", well, "my plate", "4")) for line, well in places)
    return Finding(rule, Severity.ERROR, "It happened.", sites)


def label(file: str, bad: bool, *rules: str, adjusted: bool | None = None, **more: object) -> Label:
    return Label(file, "pcr", bad, bad if adjusted is None else adjusted, rules, **more)  # type: ignore[arg-type]


def said(file: str, *findings: Finding, family: str = "pcr", problem: str = "") -> Prediction:
    return Prediction(file, family, findings, seconds=1.0, problem=problem)


def scored(*pairs: tuple[Label, Prediction]) -> Layer1Result:
    return score_predictions("set", [a for a, _ in pairs], [b for _, b in pairs], "rules-only")


def test_strict_and_adjusted_labels_are_scored_apart() -> None:
    result = scored(
        (label("a", True, "PCR-1"), said("a", finding("PCR-1"))),
        (label("b", False), said("b")),
        (label("c", False, "SD-5", adjusted=True), said("c", finding("SD-5"))),
    )
    assert (result.strict.true_positives, result.strict.false_positives) == (1, 1)
    assert (result.adjusted.true_positives, result.adjusted.false_positives) == (2, 0)
    assert result.adjusted.f1.value == 1.0
    assert result.strict.precision.value == 0.5
    # The rule that a strict pass lists is acceptable under either label.
    assert result.rules_strict.false_findings == 0
    assert result.rules_adjusted.reported == result.rules_adjusted.violations == 2
    assert result.rules_strict.violations == 1


def test_what_could_not_be_judged_is_wrong_whatever_its_label() -> None:
    result = scored(
        (label("a", True, "PCR-1"), said("a", problem="crashed", family="")),
        (label("b", False), said("b", problem="crashed", family="")),
    )
    assert (result.adjusted.false_negatives, result.adjusted.false_positives) == (1, 1)
    assert result.adjusted.true_negatives == 0
    assert [row.file for row in result.unjudged] == ["a", "b"]
    assert "2 could not be judged" in result.text()


def test_an_acceptable_rule_stands_for_one_violation_only() -> None:
    entry = label("a", True, "PCR-1", "PCR-2", also_acceptable=("PCR-6",))
    assert set(cite(entry, said("a", finding("PCR-6")))) == {"PCR-1"}
    assert set(cite(entry, said("a", finding("PCR-2"), finding("PCR-6")))) == {"PCR-1", "PCR-2"}
    assert cite(entry, said("a", finding("SD-5"))) == {}


def test_false_findings_and_families_are_counted() -> None:
    result = scored(
        (label("a", False), said("a", finding("PCR-2"), finding("PCR-2"))),
        (label("b", True, "PCR-1"), said("b", finding("PCR-1"), finding("SD-5"), family="x")),
        (label("c", False), said("c")),
    )
    level = result.rules_adjusted
    assert (level.findings, level.false_findings) == (4, 3)
    assert (level.correct, level.correct_with_false) == (2, 1)
    assert result.family_right == 2
    assert "b: false SD-5; family pcr taken for x" in result.text()


def test_wells_match_by_slot_or_label_and_lines_by_number() -> None:
    entry = label(
        "a",
        True,
        "PCR-2",
        wells={"PCR-2": ("4:A1", "my plate:B1", "4:C1")},
        lines={"PCR-2": (10, 20)},
    )
    result = scored((entry, said("a", finding("PCR-2", (10, "A1"), (11, "B1"), (12, "H9")))))
    wells, lines = result.rules_adjusted.wells, result.rules_adjusted.lines
    assert (wells.labelled_hit, wells.labelled) == (2, 3)
    assert (wells.reported_hit, wells.reported) == (2, 3)
    assert (lines.labelled_hit, lines.labelled, lines.reported) == (1, 2, 3)


def test_intervals_are_seeded_and_hold_the_value() -> None:
    pairs = [
        (label(str(n), n % 2 == 0), said(str(n), *[finding("PCR-1")] * (n % 3 == 0)))
        for n in range(20)
    ]
    one, two = scored(*pairs), scored(*pairs)
    assert one.adjusted == two.adjusted
    f1 = one.adjusted.f1
    assert f1.low is not None
    assert f1.high is not None
    assert f1.value is not None
    assert f1.low < f1.value < f1.high


def test_scores_of_an_all_correct_folder_are_not_made_up() -> None:
    result = scored((label("a", False), said("a")))
    assert result.adjusted.f1.value is None
    assert json.loads(json.dumps(result.to_json()))["adjusted"]["f1"]["value"] is None
    assert "not defined" in result.text()


GOOD_ENTRY = {"file": "a.py", "family": "pcr", "verdict": "fail", "rules": ["PCR-1"]}


def folder(tmp_path: Path, content: object) -> Path:
    (tmp_path / "a.py").write_text("def run(p): pass\n", encoding="utf-8")
    text = content if isinstance(content, str) else json.dumps(content)
    (tmp_path / "labels.json").write_text(text, encoding="utf-8")
    return tmp_path


def test_labels_are_read(tmp_path: Path) -> None:
    entry = {
        **GOOD_ENTRY,
        "verdict": "pass",
        "adjusted_verdict": "fail",
        "wells": {"PCR-1": ["4:A1"]},
    }
    (read,) = read_labels(folder(tmp_path, [entry]), FAMILIES, RULES)
    assert (read.is_bad, read.is_bad_adjusted) == (False, True)
    assert read.acceptable == {"PCR-1"}
    assert read.wells == {"PCR-1": ("4:A1",)}


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("", "is not JSON"),
        ("{", "is not JSON"),
        ({}, "expected a list"),
        ([], "the list is empty"),
        ([3], "entry 1 is no object"),
        ([{**GOOD_ENTRY, "file": "b.py"}], "entry 1 (b.py): there is no such file"),
        ([GOOD_ENTRY, GOOD_ENTRY], "entry 2 (a.py): is labelled twice"),
        ([{**GOOD_ENTRY, "family": "PCR"}], "family is 'PCR', not one of pcr"),
        ([{**GOOD_ENTRY, "verdict": "bad"}], "verdict is 'bad', not one of pass, fail"),
        ([{**GOOD_ENTRY, "adjusted_verdict": 1}], "adjusted_verdict is 1"),
        ([{**GOOD_ENTRY, "rules": ["PCR-9"]}], "rules: there is no rule 'PCR-9'"),
        ([{**GOOD_ENTRY, "rules": "PCR-1"}], "rules is no list"),
        ([{**GOOD_ENTRY, "lines": {"PCR-1": ["7"]}}], "lines.PCR-1: expected a list of lines"),
        ([{**GOOD_ENTRY, "wells": ["4:A1"]}], "wells is no object"),
    ],
)
def test_bad_labels_are_told_in_one_line(tmp_path: Path, content: object, words: str) -> None:
    with pytest.raises(DatasetError) as caught:
        read_labels(folder(tmp_path, content), FAMILIES, RULES)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_everything_wrong_is_reported_at_once(tmp_path: Path) -> None:
    bad = {"file": "a.py", "family": "x", "verdict": "y", "rules": ["Z"]}
    with pytest.raises(DatasetError) as caught:
        read_labels(folder(tmp_path, [bad]), FAMILIES, RULES)
    for words in ("family is 'x'", "verdict is 'y'", "no rule 'Z'"):
        assert words in str(caught.value)


def test_a_judge_that_skips_a_protocol_is_refused(tmp_path: Path) -> None:
    def lazy(files: Sequence[Path], done: Callable[[Prediction], None]) -> list[Prediction]:
        return []

    with pytest.raises(DatasetError):
        evaluate_layer1(tmp_path, [label("a", False)], lazy, "lazy")


def test_the_rules_judge_a_real_folder() -> None:
    from aegis_ot.preflight import load_rules
    from aegis_ot.workbench import CheckSettings

    rule_set = load_rules()
    benchmark = Path(__file__).parents[4] / "examples" / "benchmark"
    families = [family.family for family in rule_set.families]
    labels = read_labels(benchmark, families, [rule.id for rule in rule_set.rules])
    assert sum(entry.is_bad for entry in labels) == 13
    some = [entry for entry in labels if entry.file in ("b02.py", "b04.py", "b06.py")]
    judge = Checking(CheckSettings(), rule_set)
    result = evaluate_layer1(benchmark, some, judge, "rules-only")
    assert result.adjusted.f1.value == 1.0
    assert result.family_right == 3
    assert all(row.seconds > 0 for row in result.rows)
