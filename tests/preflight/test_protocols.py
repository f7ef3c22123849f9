"""Whole protocols, from text to verdict. The first line of each says what must come out."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.preflight import Database, Report, check_script, load_database
from aegis_ot.preflight.rehearsal import Script

FILES = sorted((Path(__file__).parent / "protocols").glob("*.py"))


@pytest.fixture(scope="module")
def database() -> Database:
    return load_database()


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_verdict_family_and_rules(path: Path, database: Database) -> None:
    text = path.read_text(encoding="utf-8")
    family, verdict, *rules = text.splitlines()[0].removeprefix("# expect:").split()
    report = _check(text, path.name, database)
    found = {finding.rule for finding in report.findings}
    assert report.family == family
    assert report.verdict.value == verdict, report.findings
    assert {rule for rule in rules if not rule.endswith("?")} <= found
    assert found <= {rule.rstrip("?") for rule in rules}
    for finding in report.findings:
        assert finding.lines
        assert finding.wells
        assert finding.why
        assert finding.fix


def _check(text: str, name: str, database: Database) -> Report:
    return check_script(Script(text, name), database)


def test_a_waiver_with_a_reason_covers_a_finding(database: Database) -> None:
    text = (Path(__file__).parent / "protocols" / "sd_tutorial_one_tip.py").read_text()
    waived = _check("# aegis: ignore[SD-5] the tutorial's own way\n" + text, "t.py", database)
    assert waived.verdict.value == "pass"
    assert [w.finding.rule for w in waived.waived] == ["SD-5"]
    bare = _check("# aegis: ignore[SD-5]\n" + text, "t.py", database)
    assert bare.verdict.value == "fail"
    assert "gives no reason" in bare.notes[0]


def test_a_stale_waiver_is_reported(database: Database) -> None:
    text = (Path(__file__).parent / "protocols" / "sd_tubes_good.py").read_text()
    report = _check("# aegis: ignore[SD-5] one tip is fine here\n" + text, "t.py", database)
    assert any("stale" in note for note in report.notes)
