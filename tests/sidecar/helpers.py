"""Keyframes, cameras and analysers for the sidecar's tests."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import Any

import httpx
import numpy as np

from aegis_ot.errors import CameraError
from aegis_ot.sidecar.analysis import Judged
from aegis_ot.sidecar.cameras.codec import encode_jpeg
from aegis_ot.vision.camera import Frame
from aegis_ot.vocabulary import (
    FailureType,
    Gate,
    Keyframe,
    KeyframeKind,
    Outcome,
    Route,
    Verdict,
    WellRef,
    to_json,
)

KINDS = tuple(KeyframeKind)


def make_keyframe(run: str, sequence: int, **changes: Any) -> Keyframe:
    """Keyframe ``sequence`` of a run whose trajectories follow each other, four each."""
    trajectory, moment = divmod(sequence, 4)
    values: dict[str, Any] = {
        "run": run,
        "sequence": sequence,
        "trajectory": trajectory,
        "kind": KINDS[moment],
        "pipette": "p1000_single_gen2",
        "mount": "left",
        "channels": 1,
        "tip": "1:A1",
        "sources": (WellRef("r", "A1", "reservoir", "2"),),
        "destinations": (WellRef("p", f"A{trajectory + 1}", "plate", "4"),),
        "commanded_ul": 100.0,
        "expected_ul": 100.0 if moment < 2 else 0.0,
        "capacity_ul": 1000.0,
        "line": 12,
    }
    return Keyframe(**(values | changes))


def make_jpeg(grey: int = 100) -> bytes:
    return encode_jpeg(np.full((48, 64, 3), grey, np.uint8))


class StubCamera:
    """Gives a frame at once, unless it is told to fail, to wait, or to give an old one."""

    kind = "stub"

    def __init__(self) -> None:
        self.failure: Exception | None = None
        self.age = 0.0
        self.gate = threading.Event()
        self.gate.set()
        self.grabbed: list[int] = []
        self.announced: list[int] = []
        self.closed = False

    def announce(self, keyframe: Keyframe) -> None:
        self.announced.append(keyframe.sequence)

    def frame_after(self, moment: float, timeout: float) -> Frame:
        if not self.gate.wait(timeout):
            raise CameraError("no frame in time")
        if self.failure is not None:
            raise self.failure
        sequence = self.announced[-1]
        self.grabbed.append(sequence)
        image = np.full((48, 64, 3), sequence % 256, np.uint8)
        return Frame(encode_jpeg(image), image, max(moment, time.monotonic()) - self.age)

    def close(self) -> None:
        self.closed = True


class StubAnalyser:
    """Passes, but fails the trajectories in ``fails`` and cannot decide those in ``unsure``."""

    def __init__(self, fails: Sequence[int] = (), unsure: Sequence[int] = ()) -> None:
        self.fails = fails
        self.unsure = unsure
        self.failure = FailureType.PARTIAL_DISPENSE
        self.histories: list[list[Judged]] = []
        self.observed: list[tuple[str, int]] = []
        self.confirmed: list[int] = []
        self.gate = threading.Event()
        self.gate.set()

    def begin(self, run: str, history: Sequence[Judged] = ()) -> StubRun:
        self.histories.append(list(history))
        return StubRun(self, run)


class StubRun:
    def __init__(self, analyser: StubAnalyser, run: str) -> None:
        self.analyser = analyser
        self.run = run

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        assert frame.image.shape == (48, 64, 3)
        self.analyser.observed.append((self.run, keyframe.sequence))

    def confirm(self, trajectory: int) -> None:
        self.analyser.confirmed.append(trajectory)

    def judge(self, trajectory: int) -> Judged:
        assert self.analyser.gate.wait(60)
        evidence = {"boxes": {"aspirate": np.array([1.0, 2.0, 30.0, 40.0])}, "blobs": np.int64(3)}
        if trajectory in self.analyser.fails:
            verdict = Verdict(
                self.run,
                trajectory,
                Outcome.FAIL,
                Route.GREY_ZONE,
                9.5,
                Gate.VOLUMETRIC,
                self.analyser.failure,
                "52 µL stayed in the tip.",
                52.0,
                0.0,
            )
        elif trajectory in self.analyser.unsure:
            verdict = Verdict(
                self.run, trajectory, Outcome.UNDECIDED, Route.GREY_ZONE, 4.2, reason="Unclear."
            )
        else:
            verdict = Verdict(self.run, trajectory, Outcome.PASS, Route.SILENT_PASS, 1.0)
        return verdict, evidence


class Robot:
    """Speaks the wire protocol over a real socket."""

    def __init__(self, url: str, run: str = "run-1", token: str | None = None) -> None:
        headers = {} if token is None else {"Authorization": f"Bearer {token}"}
        self.http = httpx.Client(base_url=url, headers=headers, timeout=60, trust_env=False)
        self.run = run

    def __enter__(self) -> Robot:
        return self

    def __exit__(self, *_: object) -> None:
        self.http.close()

    def register(self) -> httpx.Response:
        start = {
            "run": self.run,
            "protocol": "demo.py",
            "robot": "OT-2",
            "api_level": "2.15",
            "simulated": True,
            "started": 1.5,
            "package": "0.1",
        }
        return self.http.put(f"/v1/runs/{self.run}", json=start)

    def send(self, sequence: int, **changes: Any) -> httpx.Response:
        keyframe = make_keyframe(self.run, sequence, **changes)
        return self.http.post(f"/v1/runs/{self.run}/keyframes", json=to_json(keyframe))

    def cycle(self, trajectory: int) -> None:
        for sequence in range(4 * trajectory, 4 * trajectory + 4):
            assert self.send(sequence).status_code == 200

    def verdict(self, trajectory: int, wait: float | None = None) -> dict[str, Any]:
        """The answer to one question; without ``wait`` it is asked until there is a verdict.

        One question waits for a second at most, and a busy machine may need longer.
        """
        path = f"/v1/runs/{self.run}/trajectories/{trajectory}/verdict"
        deadline = time.monotonic() + 60.0
        while True:
            answer = self.http.get(path, params={"wait": 1.0 if wait is None else wait})
            assert answer.status_code == 200, answer.text
            body: dict[str, Any] = answer.json()
            if wait is not None or body["verdict"] is not None:
                return body
            assert time.monotonic() < deadline, "there is no verdict"

    def post(self, path: str, body: Any) -> httpx.Response:
        return self.http.post(f"/v1/runs/{self.run}/{path}", json=body)

    def overview(self) -> dict[str, Any]:
        body: dict[str, Any] = self.http.get(f"/v1/runs/{self.run}").json()
        return body


def until(condition: Callable[[], bool], seconds: float = 60.0) -> None:
    """Wait for what another thread of the sidecar will have done."""
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, "it did not come"
        time.sleep(0.01)
