"""A broken or slow analyser: never a lost verdict, never a dead worker."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aegis_ot.sidecar import SidecarConfig, running_sidecar, service, worker
from aegis_ot.sidecar.analysis import Judged, plain
from aegis_ot.sidecar.app import create_app
from aegis_ot.sidecar.wire import RunStart
from aegis_ot.sidecar.worker import FRAMES_IN_MEMORY
from aegis_ot.vision.camera import Frame
from aegis_ot.vocabulary import Keyframe, KeyframeKind, Outcome, Route, Verdict
from tests.runtime.test_live import in_time

from .helpers import Robot, StubAnalyser, StubCamera


class Broken:
    """Works, except where told what to do instead."""

    def __init__(
        self,
        begin: Callable[[], None] = lambda: None,
        observe: Callable[[Keyframe], None] = lambda keyframe: None,
        judge: Callable[[int], Any] | None = None,
    ) -> None:
        self._begin, self._observe, self._judge = begin, observe, judge

    def begin(self, run: str, history: Sequence[Judged] = ()) -> Broken:
        self._begin()
        self.run = run
        return self

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        self._observe(keyframe)

    def judge(self, trajectory: int) -> Any:
        if self._judge is not None and trajectory == 0:
            return self._judge(trajectory)
        return Verdict(self.run, trajectory, Outcome.PASS, Route.SILENT_PASS), {}


def boom(*_: object) -> None:
    raise ZeroDivisionError("by nought")


def boom_in_the_first(keyframe: Keyframe) -> None:
    if keyframe.trajectory == 0 and keyframe.kind is KeyframeKind.TRANSIT:
        boom()


def verdict_of(run: str, trajectory: int, **more: Any) -> Verdict:
    return Verdict(run, trajectory, Outcome.PASS, Route.SILENT_PASS, **more)


@pytest.mark.parametrize(
    ("analyser", "reason"),
    [
        (Broken(observe=boom_in_the_first), "transit frame could not be analysed: ZeroDivision"),
        (Broken(judge=boom), "analyser failed: ZeroDivisionError: by nought"),
        (Broken(judge=lambda n: None), "analyser failed"),
        (Broken(judge=lambda n: ("pass", {})), "no verdict"),
        (Broken(judge=lambda n: (verdict_of("other", n), {})), "instead"),
        (Broken(judge=lambda n: (verdict_of("run-1", n + 1), {})), "instead"),
        (Broken(judge=lambda n: (verdict_of("run-1", n, score=float("nan")), {})), "no number"),
    ],
)
def test_a_broken_judgement_is_undecided_and_the_next_well_is_judged(
    config: SidecarConfig, analyser: Broken, reason: str
) -> None:
    with running_sidecar(config, StubCamera(), analyser) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        verdict = robot.verdict(0)["verdict"]
        assert verdict["outcome"] == "undecided"
        assert reason in verdict["reason"]
        robot.cycle(1)
        assert robot.verdict(1)["verdict"]["outcome"] == "pass"


def test_an_analyser_that_cannot_begin_leaves_every_well_undecided(config: SidecarConfig) -> None:
    with running_sidecar(config, StubCamera(), Broken(begin=boom)) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        robot.cycle(1)
        for trajectory in (0, 1):
            verdict = robot.verdict(trajectory)["verdict"]
            assert (verdict["outcome"], verdict["route"]) == ("undecided", "uncalibrated")
            assert "could not begin" in verdict["reason"]


def test_without_an_analyser_nothing_passes(config: SidecarConfig) -> None:
    with running_sidecar(config, StubCamera()) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        assert robot.verdict(0)["verdict"]["outcome"] == "undecided"


def test_a_slow_analyser_holds_up_no_keyframe_and_loses_none(config: SidecarConfig) -> None:
    gate = threading.Event()
    seen: list[int] = []

    def observe(keyframe: Keyframe) -> None:
        assert gate.wait(60)
        seen.append(keyframe.sequence)

    with running_sidecar(config, StubCamera(), Broken(observe=observe)) as url, Robot(url) as robot:
        robot.register()
        last = FRAMES_IN_MEMORY
        for trajectory in range(last + 1):
            robot.cycle(trajectory)
        gate.set()
        assert robot.verdict(last)["verdict"]["outcome"] == "pass"
    assert seen == list(range(4 * (last + 1)))


def test_a_frame_lost_from_the_store_is_told(config: SidecarConfig, tmp_path: Path) -> None:
    gate = threading.Event()
    analyser = Broken(begin=lambda: gate.wait(60) and None)
    with running_sidecar(config, StubCamera(), analyser) as url, Robot(url) as robot:
        robot.register()
        for trajectory in range(4):
            robot.cycle(trajectory)
        for path in (config.data / "frames").glob("*/000015.jpg"):
            path.unlink()
        gate.set()
        verdict = robot.verdict(3)["verdict"]
        assert verdict["outcome"] == "undecided"
        assert "post_dispense frame could not be analysed" in verdict["reason"]


def test_evidence_becomes_plain_json() -> None:
    assert plain(
        {
            KeyframeKind.ASPIRATE: np.float32(0.5),
            "nan": float("nan"),
            "boxes": (np.array([1, 2]), None, True),
            3: Path("x"),
        }
    ) == {"aspirate": 0.5, "nan": None, "boxes": [[1, 2], None, True], "3": "x"}


def analysing() -> list[str]:
    return [thread.name for thread in threading.enumerate() if thread.name.startswith("analysis-")]


def test_a_run_that_has_nothing_to_score_holds_no_thread(
    config: SidecarConfig, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(worker, "LINGER_S", 0.05)
    analyser = StubAnalyser()
    with running_sidecar(config, StubCamera(), analyser) as url, Robot(url) as robot:
        for number in range(40):
            assert robot.http.put(f"/v1/runs/{number}", json={"run": str(number)}).is_success
        assert analysing() == []
        robot.register()
        for trajectory in range(2):  # the second one finds the first one's thread gone
            robot.cycle(trajectory)
            assert robot.verdict(trajectory)["verdict"]["outcome"] == "pass"
            in_time(lambda: analysing() == [])
    assert len(analyser.histories) == 1


def test_runs_that_only_registered_leave_memory(
    config: SidecarConfig, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(service, "EMPTY_S", 0.0)
    sidecar = create_app(config, StubCamera(), StubAnalyser()).state.sidecar
    for number in range(40):
        sidecar.register(RunStart(run=str(number)))
    assert len(sidecar._sessions) <= service.SESSIONS_KEPT
    sidecar.close()
