"""Runs drawn at random: no well passes without frames of its own, exposed while its robot stood."""

from __future__ import annotations

import pytest

from benchmarks.unseen import main

RUNS = 24
"""``python -m benchmarks.unseen`` draws 1,000."""


def test_no_well_passes_unseen(capsys: pytest.CaptureFixture[str]) -> None:
    status = main(["--runs", str(RUNS), "--seed", "3"])
    said = capsys.readouterr().out
    assert status == 0, said
    assert "wells that the robot passed" in said
