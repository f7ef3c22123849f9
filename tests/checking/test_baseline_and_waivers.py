from __future__ import annotations

import json
from pathlib import Path

import pytest

from aegis_ot.checking import CheckedProtocol
from aegis_ot.checking.baseline import baseline_text, read_baseline
from aegis_ot.checking.configuration import ConfiguredWaiver
from aegis_ot.checking.waiving import waive
from aegis_ot.errors import ConfigurationError
from aegis_ot.preflight import Report
from aegis_ot.vocabulary import Finding, Severity, Site, VerdictWord, WellRef


def finding(rule: str, line: int, well: str) -> Finding:
    site = Site(line, WellRef("plate", well, "plate", "1"), "did it")
    return Finding(rule, Severity.ERROR, "It happened.", (site,))


def known(folder: Path, findings: list[Finding], lines: list[str]) -> Path:
    report = Report("p.py", "pcr", VerdictWord.FAIL, tuple(findings), ())
    checked = CheckedProtocol(str(folder / "p.py"), report=report, lines=tuple(lines))
    path = folder / "baseline.json"
    path.write_text(baseline_text(path, [checked]), encoding="utf-8")
    return path


def test_a_known_finding_stays_known_when_lines_move(tmp_path: Path) -> None:
    baseline = read_baseline(known(tmp_path, [finding("PCR-2", 2, "A1")], ["x", "  go( a )"]))
    moved = finding("PCR-2", 4, "A1")
    fresh, old, gone = baseline.split(
        str(tmp_path / "p.py"), [moved], ["x", "", "# more", "go( a )"]
    )
    assert (fresh, old, gone) == ([], [moved], 0)


@pytest.mark.parametrize(
    ("file", "new"),
    [
        ("p.py", finding("PCR-3", 2, "A1")),
        ("p.py", finding("PCR-2", 2, "A2")),
        ("p.py", finding("PCR-2", 1, "A1")),
        ("q.py", finding("PCR-2", 2, "A1")),
    ],
)
def test_another_rule_well_line_or_file_is_new(tmp_path: Path, file: str, new: Finding) -> None:
    baseline = read_baseline(known(tmp_path, [finding("PCR-2", 2, "A1")], ["x", "go()"]))
    fresh, old, _ = baseline.split(str(tmp_path / file), [new], ["x", "go()"])
    assert (fresh, old) == ([new], [])


def test_a_second_one_like_it_is_new_and_a_mended_one_is_gone(tmp_path: Path) -> None:
    same = finding("PCR-2", 2, "A1")
    baseline = read_baseline(known(tmp_path, [same], ["x", "go()"]))
    fresh, old, _ = baseline.split(str(tmp_path / "p.py"), [same, same], ["x", "go()"])
    assert (len(fresh), len(old)) == (1, 1)
    assert baseline.split(str(tmp_path / "p.py"), [], ["x", "go()"])[2] == 1


@pytest.mark.parametrize("text", ["", "{", "[]", '{"schema": 1}', '{"schema": 9, "findings": []}'])
def test_a_bad_baseline_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "b.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ConfigurationError):
        read_baseline(path)


def test_the_baseline_names_no_absolute_path(tmp_path: Path) -> None:
    path = known(tmp_path, [finding("PCR-2", 2, "A1")], ["x", "go()"])
    assert json.loads(path.read_text(encoding="utf-8"))["findings"][0]["file"] == "p.py"


def test_waivers_of_the_configuration_cover_by_file_and_can_be_stale(tmp_path: Path) -> None:
    waivers = [
        ConfiguredWaiver(("PCR-2",), "accepted", ("old/*.py",)),
        ConfiguredWaiver(("PCR-5",), "accepted", ("old/*.py",)),
        ConfiguredWaiver(("GEN-1",), "everywhere"),
    ]
    findings = [finding("PCR-2", 2, "A1"), finding("PCR-3", 2, "A1")]
    report = Report(
        "p.py", "pcr", VerdictWord.FAIL, tuple(findings), (), judged=("PCR-2", "PCR-3", "PCR-5")
    )
    standing, waived, remarks = waive(str(tmp_path / "old" / "p.py"), report, waivers, tmp_path)
    assert [f.rule for f in standing] == ["PCR-3"]
    assert [(w.finding.rule, w.waiver.reason) for w in waived] == [("PCR-2", "accepted")]
    assert len(remarks) == 1
    assert "PCR-5" in remarks[0].message
    elsewhere = waive(str(tmp_path / "new" / "p.py"), report, waivers, tmp_path)
    assert [f.rule for f in elsewhere[0]] == ["PCR-2", "PCR-3"]
