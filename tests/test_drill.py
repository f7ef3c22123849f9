"""A short drill: a sidecar process that is killed and restarted within a run."""

from __future__ import annotations

import sys

import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the drill needs Linux")


def test_a_short_drill_loses_nothing(capfd: pytest.CaptureFixture[str]) -> None:
    from benchmarks.drill.__main__ import main

    assert main(["--scale", "0.05", "--only", "restarts"]) == 0
    assert "all kept, none hanging, named" in capfd.readouterr().out
