from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.preflight import Report
from aegis_ot.vocabulary import Finding, Severity, Site, VerdictWord, WellRef
from aegis_ot.workbench import CheckedProtocol, Problem
from aegis_ot.workbench.baseline import baseline_text, read_baseline
from aegis_ot.workbench.configuration import ConfiguredWaiver
from aegis_ot.workbench.project_waivers import waive, with_stale_waivers


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


WAIVERS = [
    ConfiguredWaiver(("PCR-2",), "accepted", ("old/*.py",)),
    ConfiguredWaiver(("PCR-5",), "accepted", ("old/*.py",)),
    ConfiguredWaiver(("GEN-1",), "everywhere"),
    ConfiguredWaiver(("PCR-3",), "everywhere"),
]


def judged(file: Path, *findings: Finding) -> CheckedProtocol:
    rules = ("PCR-2", "PCR-3", "PCR-5")
    report = Report("p.py", "pcr", VerdictWord.FAIL, findings, (), judged=rules)
    standing, waived = waive(str(file), report, WAIVERS, file.parents[1])
    report = dataclasses.replace(report, findings=tuple(standing), waived=tuple(waived))
    return CheckedProtocol(str(file), report=report)


def test_waivers_of_the_configuration_cover_by_file(tmp_path: Path) -> None:
    findings = [finding("PCR-2", 2, "A1"), finding("PCR-6", 2, "A1")]
    old = judged(tmp_path / "old" / "p.py", *findings)
    assert [f.rule for f in old.findings] == ["PCR-6"]
    assert [(w.finding.rule, w.waiver.reason) for w in old.waived] == [("PCR-2", "accepted")]
    new = judged(tmp_path / "new" / "p.py", *findings)
    assert [f.rule for f in new.findings] == ["PCR-2", "PCR-6"]


def test_a_waiver_of_the_configuration_is_stale_if_none_of_its_protocols_needs_it(
    tmp_path: Path,
) -> None:
    """Those of GEN-1, which was not judged, and of PCR-2 and PCR-3, which one needs, are not."""
    protocols = [
        judged(tmp_path / "new" / "p.py"),
        judged(tmp_path / "old" / "p.py", finding("PCR-3", 2, "A1")),
        judged(tmp_path / "old" / "q.py", finding("PCR-2", 2, "A1")),
        CheckedProtocol(str(tmp_path / "old" / "r.py"), problem=Problem("raises")),
    ]
    told = with_stale_waivers(protocols, WAIVERS, tmp_path)
    assert [len(checked.remarks) for checked in told] == [0, 1, 0, 0]
    (remark,) = told[1].remarks
    assert "waiver of PCR-5 in " in remark.message
    assert "pyproject.toml is stale: nothing is found in the 2 checked" in remark.message


def test_one_file_does_not_make_a_waiver_for_all_stale(tmp_path: Path) -> None:
    new = [judged(tmp_path / "new" / name) for name in ("p.py", "q.py")]
    assert not with_stale_waivers(new[:1], WAIVERS, tmp_path)[0].remarks
    first, second = with_stale_waivers(new, WAIVERS, tmp_path)
    assert [one.message.split(" in ")[0] for one in first.remarks] == ["The waiver of PCR-3"]
    assert not second.remarks
