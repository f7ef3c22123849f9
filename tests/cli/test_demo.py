"""What the README's first command shows a newcomer, on the whole plate: it may never be untrue."""

from __future__ import annotations

from pathlib import Path

import pytest


def test_a_seed_below_nought_is_refused_before_anything_runs(aegis):
    result = aegis("simulate", "examples/demo/hello_guard.py", "--seed", "-1")
    assert result.code == 2
    assert "--seed" in result.err
    assert "greater than or equal to 0" in result.err


@pytest.mark.timeout(400)  # two whole plates; a busy machine takes three times as long
def test_the_demo_catches_what_it_says_and_gives_no_false_alarm(aegis, tmp_path: Path):
    result = aegis("demo")
    assert "MISSED" not in result.out
    assert result.out.count("  caught  ") == 3
    assert result.code == 0
    report = (tmp_path / "out" / "demo-report.html").read_text(encoding="utf-8")
    assert "D4" in report
    assert "simulated" in report
    assert "first wells trust" in report, "nobody is there to be asked"
