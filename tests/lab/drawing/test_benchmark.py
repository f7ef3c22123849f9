"""The benchmark runs; its figures are printed, not asserted."""

from __future__ import annotations

from aegis_ot_lab.drawing.benchmark import measure


def test_it_measures_every_case() -> None:
    costs = measure(frames=2)
    assert len({cost.what for cost in costs}) == 3
    assert all(cost.cpu_ms > 0 for cost in costs)
