"""``aegis_ot.check``: a file, a text, and what cannot be judged."""

from __future__ import annotations

from pathlib import Path

import pytest

import aegis_ot
from aegis_ot.errors import ConfigurationError, RehearsalError
from tests.cli.test_check_command import BAD_LINE, protocol


def test_a_file_and_its_unsaved_text_are_judged_where_the_file_lies(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    path = protocol(tmp_path / "lab" / "set_up.py", tips="once")
    report = aegis_ot.check(path)
    assert report.verdict == "fail"
    assert [(f.rule, f.lines) for f in report.findings] == [("PCR-3", (BAD_LINE,))]
    assert aegis_ot.check(str(path), ignore=["PCR-3"]).verdict == "pass"
    (path.parent / "helper.py").write_text("TIPS = 'always'\n", encoding="utf-8")
    text = path.read_text(encoding="utf-8").replace('"once"', "helper.TIPS")
    report = aegis_ot.check(f"import helper\n{text}", file=path)
    assert report.verdict == "pass"
    assert '"once"' in path.read_text(encoding="utf-8")


def test_what_cannot_be_judged_is_raised_with_its_line(tmp_path: Path) -> None:
    with pytest.raises(RehearsalError, match=r"^protocol\.py:3: ") as caught:
        aegis_ot.check("metadata = {'apiLevel': '2.15'}\ndef run(protocol):\n    1 / 0\n")
    assert caught.value.line == 3
    with pytest.raises(RehearsalError, match="no such file"):
        aegis_ot.check(tmp_path / "none.py")
    with pytest.raises(ConfigurationError, match="there is no rule 'PCR-99'"):
        aegis_ot.check(protocol(tmp_path / "p.py"), select=["PCR-99"])
    with pytest.raises(ConfigurationError, match="is for a text"):
        aegis_ot.check(tmp_path / "p.py", file=tmp_path / "p.py")
