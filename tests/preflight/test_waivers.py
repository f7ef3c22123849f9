"""Waivers in a protocol: those that cover a finding, and those that are told of."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.preflight import Options, Report, RuleSet, check_script, load_rules

PROTOCOLS = Path(__file__).parent / "protocols"


@pytest.fixture(scope="module")
def rule_set() -> RuleSet:
    return load_rules()


def _check(text: str, name: str, rule_set: RuleSet) -> Report:
    return check_script(Script(text, name), rule_set)


def test_a_waiver_with_a_reason_covers_a_finding(rule_set: RuleSet) -> None:
    text = (PROTOCOLS / "sd_tutorial_one_tip.py").read_text()
    waived = _check("# aegis: ignore[SD-5] the tutorial's own way\n" + text, "t.py", rule_set)
    assert waived.verdict.value == "pass"
    assert [w.finding.rule for w in waived.waived] == ["SD-5"]
    bare = _check("# aegis: ignore[SD-5]\n" + text, "t.py", rule_set)
    assert bare.verdict.value == "warn"
    assert "gives no reason" in bare.remarks[0].message
    assert bare.remarks[0].line == 1


def test_a_stale_waiver_is_reported(rule_set: RuleSet) -> None:
    text = (PROTOCOLS / "sd_tubes_good.py").read_text()
    report = _check("# aegis: ignore[SD-5] one tip is fine here\n" + text, "t.py", rule_set)
    assert [(r.line, "stale" in r.message) for r in report.remarks] == [(1, True)]


@pytest.mark.parametrize(
    "options",
    [Options(select=("SD-1",)), Options(ignore=("SD-5",)), Options(severity={"SD-5": "off"})],
    ids=["not selected", "ignored", "off"],
)
def test_a_waiver_of_a_rule_that_was_not_judged_is_not_stale(
    rule_set: RuleSet, options: Options
) -> None:
    text = (PROTOCOLS / "sd_tubes_good.py").read_text()
    script = Script("# aegis: ignore[SD-5] one tip is fine here\n" + text, "t.py")
    assert check_script(script, rule_set, options).remarks == ()


def test_a_waiver_of_an_undecided_rule_is_not_stale(rule_set: RuleSet) -> None:
    text = (PROTOCOLS / "gen_unnamed_plates_one_tip.py").read_text()
    plain = check_script(Script(text, "t.py"), rule_set, Options(assay=("pcr",)))
    rule = plain.undecided[0].rule
    waived = f"# aegis: ignore[{rule}] seen\n{text}"
    assert check_script(Script(waived, "t.py"), rule_set, Options(assay=("pcr",))).remarks == ()


def test_each_rule_of_a_waiver_is_stale_or_not_by_itself(rule_set: RuleSet) -> None:
    text = (PROTOCOLS / "sd_tutorial_one_tip.py").read_text()
    report = _check("# aegis: ignore[SD-5, SD-1] as taught\n" + text, "t.py", rule_set)
    assert [w.finding.rule for w in report.waived] == ["SD-5"]
    (remark,) = report.remarks
    assert "SD-1 is stale" in remark.message


def test_a_waiver_of_an_unknown_rule_is_told_with_its_line(rule_set: RuleSet) -> None:
    text = (PROTOCOLS / "sd_tutorial_one_tip.py").read_text()
    report = _check("\n# aegis: ignore[SD5] as taught\n" + text, "t.py", rule_set)
    assert report.verdict.value == "warn"
    (remark,) = report.remarks
    assert remark.line == 2
    assert "SD5" in remark.message
    assert "SD-5" in remark.message, "the nearest rule is named"


@pytest.mark.parametrize(
    ("comment", "words"),
    [
        ("aegis: ignore[SD-5] .", "gives no reason for waiving SD-5"),
        ("aegis: ignore[] as taught", "names no rule"),
        ("aegis: ingore[SD-5] as taught", "is not understood: write `# aegis: ignore["),
        ("aegis: ingore SD-5 as taught", "is not understood"),
        ("aegis ignore[SD-5] as taught", "is not understood"),
        ("aegis-ot: ignore[SD-5] as taught", "is not understood"),
        ("aegis: noqa[SD-5] as taught", "is not understood"),
    ],
)
def test_a_waiver_that_waives_nothing_is_told_with_its_line(
    rule_set: RuleSet, comment: str, words: str
) -> None:
    text = (PROTOCOLS / "sd_tutorial_one_tip.py").read_text()
    report = _check(f"# {comment}\n{text}", "t.py", rule_set)
    assert report.verdict.value == "warn"
    (remark,) = report.remarks
    assert remark.line == 1
    assert words in remark.message


@pytest.mark.parametrize(
    "comment",
    ["guarded by aegis: see SD-5", "aegis does not know this dye", "aegis: checked by hand (SD-5)"],
)
def test_a_comment_about_the_guard_is_no_waiver(rule_set: RuleSet, comment: str) -> None:
    text = (PROTOCOLS / "sd_tutorial_one_tip.py").read_text()
    assert _check(f"# {comment}\n{text}", "t.py", rule_set).remarks == ()


def test_a_waiver_beside_a_statement_of_many_lines_covers_it(rule_set: RuleSet) -> None:
    text = (PROTOCOLS / "gen_overfill.py").read_text()
    (finding,) = _check(text, "t.py", rule_set).findings
    lines = text.splitlines()
    line = lines[finding.lines[-1] - 1]
    head, _, inside = line.partition("(")
    lines[finding.lines[-1] - 1] = (
        f"{head}(\n        {inside[:-1]}\n    )  # aegis: ignore[{finding.rule}] a bottle"
    )
    report = _check("\n".join(lines) + "\n", "t.py", rule_set)
    assert report.findings == ()
    assert len(report.waived) == 1
    assert report.remarks == ()


def test_where_nothing_moves_no_waiver_is_stale(rule_set: RuleSet) -> None:
    text = (
        "# aegis: ignore[PCR-1, GEN-3] the NTC is added by hand\n"
        "metadata = {'apiLevel': '2.15'}\n"
        "def run(protocol):\n"
        "    plate = protocol.load_labware('nest_96_wellplate_100ul_pcr_full_skirt', 2)\n"
        "    protocol.comment('PCR master mix, template, NTC')\n"
    )
    report = _check(text, "t.py", rule_set)
    assert report.undecided == ()
    assert "PCR-1" not in report.judged
    assert not any("PCR-1" in remark.message for remark in report.remarks)
