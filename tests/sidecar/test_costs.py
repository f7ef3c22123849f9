"""What asking models took in a run is summed, for the page and the report."""

from __future__ import annotations

from typing import Any

from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.analysis import Judged

from .helpers import Robot, StubAnalyser, StubCamera, StubRun

COST: dict[str, Any] = {
    "model": "small", "calls": 1, "tokens_in": 900, "tokens_out": 100, "amount": 0.01,
    "currency": "USD", "seconds": 1.5,
}  # fmt: skip


class Asks(StubAnalyser):
    """Each well was shown to a small model, and the second to one without a price too."""

    def begin(self, run: str, history: Any = ()) -> StubRun:
        return _Asks(self, run)


class _Asks(StubRun):
    def judge(self, trajectory: int) -> Judged:
        verdict, evidence = super().judge(trajectory)
        more = [COST | {"model": "large", "amount": None}] if trajectory == 1 else []
        return verdict, {**evidence, "costs": [COST, *more]}


def test_costs_of_a_run_are_summed(config: SidecarConfig, camera: StubCamera) -> None:
    with running_sidecar(config, camera, Asks()) as url, Robot(url) as robot:
        robot.register()
        assert robot.overview()["costs"] is None
        for trajectory in range(2):
            robot.cycle(trajectory)
            assert robot.verdict(trajectory)["verdict"] is not None
        assert robot.overview()["costs"] == {
            "models": "large, small",
            "calls": 3,
            "unpriced_calls": 1,
            "tokens_read": 2700,
            "tokens_written": 300,
            "seconds": 4.5,
            "USD": 0.02,
        }
