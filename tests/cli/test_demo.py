"""What the README's first command shows a newcomer, on the whole plate: it may never be untrue."""

from __future__ import annotations

from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def test_a_seed_below_nought_is_refused_before_anything_runs(aegis):
    result = aegis("simulate", "examples/demo/hello_guard.py", "--seed", "-1")
    assert result.code == 2
    assert "--seed" in result.err
    assert "-1 is not in the range" in result.err


def test_one_fault_in_every_well_of_a_liquid_does_not_pass_a_dry_run(aegis):
    """Eight wells that agree with each other, and nobody there to be asked."""
    protocol = ROOT / "examples/demo/hello_guard.py"
    planted = [arg for n in range(1, 9) for arg in ("--fault", f"no_aspirate@#{n}")]
    result = aegis("simulate", protocol, *planted)
    assert result.code == 1
    assert "0 passed, 8 flagged" in result.out.replace("\n", " ")
    assert result.out.count("Please look at the tip and the well") == 1, "one question, told once"


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
