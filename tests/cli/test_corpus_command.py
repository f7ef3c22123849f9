from __future__ import annotations

import json
from pathlib import Path

import pytest

from .commands import Command
from .test_check_command import protocol


def test_a_corpus_is_told_and_compared(aegis: Command, tmp_path: Path) -> None:
    protocol(tmp_path / "shelf" / "pcr.py", tips="once")
    first = aegis("corpus", "shelf", "--out", "first.csv")
    assert first.code == 0
    assert "1 protocol: fail 1." in first.out
    assert "Protocols by broken rule: PCR-3:error 1." in first.out
    assert "fail   shelf/pcr.py" in first.err
    assert (tmp_path / "first.findings.jsonl").is_file()

    protocol(tmp_path / "shelf" / "pcr.py")
    second = aegis("corpus", "shelf", "--out", "second.csv", "--against", "first.csv")
    assert second.code == 1
    assert "Against first.csv: 1 of 1 protocols changed." in second.out
    assert "shelf/pcr.py: fail -> pass; PCR-3:error*1 -> no rule" in second.out
    assert "- PCR-3 error [" in second.out

    again = aegis("corpus", "shelf", "--out", "second.csv", "--against", "second.csv")
    assert again.code == 0
    assert "0 of 1 protocols changed." in again.out


def test_a_file_name_is_no_formula_of_a_spreadsheet(aegis: Command, tmp_path: Path) -> None:
    protocol(tmp_path / "=1+1" / "pcr.py")
    assert aegis("corpus", "=1+1", "--out", "r.csv").code == 0
    assert "\n'=1+1/pcr.py," in (tmp_path / "r.csv").read_text(encoding="utf-8")
    again = aegis("corpus", "=1+1", "--out", "r.csv", "--against", "r.csv")
    assert "0 of 1 protocols changed." in again.out


def test_an_error_does_not_repaint_the_terminal(aegis: Command) -> None:
    result = aegis("simulate", "a\x1b[2J\n::error::b.py")
    assert result.code == 2
    assert "\x1b" not in result.err
    assert not any(line.startswith("::") for line in result.err.splitlines())


def test_a_wrong_call_says_what_is_wrong(aegis: Command, tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    for arguments, words in [
        (["nowhere", "--out", "r.csv"], "nowhere: there is no such folder"),
        (["empty", "--out", "r.csv"], "There is no protocol below"),
        (["empty", "--out", "r.csv", "--against", "old.csv"], "there is no file old.csv"),
    ]:
        result = aegis("corpus", *arguments)
        assert result.code == 2
        assert words in result.err
    assert not (tmp_path / "r.csv").exists()


def test_a_ci_is_told_by_the_exit_code_and_a_project_is_heard(
    aegis: Command, tmp_path: Path
) -> None:
    pytest.importorskip("tomllib")
    protocol(tmp_path / "shelf" / "pcr.py", tips="once")
    protocol(tmp_path / "good" / "pcr.py")
    for folder, option, code in [
        ("shelf", "never", 0),
        ("shelf", "error", 1),
        ("good", "warning", 0),
        ("shelf", "often", 2),
    ]:
        assert aegis("corpus", folder, "--out", "r.csv", "--fail-on", option).code == code
    (tmp_path / "shelf" / "pyproject.toml").write_text(
        '[tool.aegis-ot.severity]\nPCR-3 = "warning"\n', encoding="utf-8"
    )
    assert aegis("corpus", "shelf", "--out", "r.csv", "--fail-on", "error").code == 0
    assert aegis("corpus", "shelf", "--out", "r.csv", "--fail-on", "warning").code == 1
    summary = json.loads((tmp_path / "r.summary.json").read_text(encoding="utf-8"))
    assert summary["verdicts"] == {"warn": 1}
    assert summary["protocols_by_rule"]["decided"]["PCR-3"] == 1
