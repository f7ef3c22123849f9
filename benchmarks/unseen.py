"""``python -m benchmarks.unseen [--runs 1000] [--seed N]``: no well passes unseen.

Runs drawn at random on the real sidecar (HTTP, SQLite, frames on disk) and the real robot half:
names used twice, in turn and at once, by guards of today and older ones; answers lost on their
way and requests sent twice; a camera that is dead, slow, hanging, or gives old frames; a sidecar
that is started anew, also without its store, or with its last frames torn. The judge passes
whatever it is shown. Afterwards each well that the robot or the sidecar counts as passed must have
four frames of its own, each exposed after the robot had come to stand for it and before it went on.
Exit status 1: one had not.
"""

from __future__ import annotations

import argparse
import contextlib
import itertools
import json
import random
import socket
import sys
import tempfile
import threading
import time
import urllib.request
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest import mock

import numpy as np

from aegis_ot.errors import AegisError, CameraError, SidecarUnreachable
from aegis_ot.run_view import state_of
from aegis_ot.runtime import Watcher
from aegis_ot.runtime import keyframe_sender as sender
from aegis_ot.runtime.sidecar_client import SidecarClient
from aegis_ot.runtime.steps import Capture, Hold
from aegis_ot.settings import Settings
from aegis_ot.sidecar import Judged, SidecarConfig, running_sidecar
from aegis_ot.sidecar.cameras.codec import encode_jpeg
from aegis_ot.sidecar.store import Store
from aegis_ot.sidecar.store.frames import FrameFiles
from aegis_ot.vision.camera import Frame
from aegis_ot.vocabulary import Keyframe, KeyframeKind, Outcome, Route, Verdict, WellRef

AT_ONCE = 3
"""Robots that run side by side."""
EACH = 12
"""Runs of one data folder."""
NAMES = (None, "plate", "plate", "plate", "plate-2", "assay")
TROUBLES = ("slow", "slow", "dead", "hanging", "old")
_DIRECT = urllib.request.build_opener(urllib.request.ProxyHandler({}))
_IMAGE = np.full((8, 8, 3), 100, np.uint8)
_JPEG = encode_jpeg(_IMAGE)
_COMMENT = b"\xff\xd8\xff\xfe\x00\x0a"
"""A JPEG's beginning with a comment of eight characters: a whole picture that a restarted sidecar
reads again."""


def _numbered(number: int) -> bytes:
    return _COMMENT + f"{number:08d}".encode() + _JPEG[2:]


def _number(frame: bytes) -> int:
    return int(frame[len(_COMMENT) :][:8])


class Camera:
    """Numbers its frames, and remembers when each was exposed, ``time.monotonic``, s."""

    kind = "drawn"

    def __init__(self, rng: random.Random) -> None:
        self.mood = "well"
        self.exposed: dict[int, float] = {}
        self._rng = rng
        self._numbers = itertools.count()

    def announce(self, keyframe: Keyframe) -> None:
        """It shows whatever there is."""

    def frame_after(self, moment: float, timeout: float) -> Frame:
        """A frame, in its present mood."""
        if self.mood == "dead":
            raise CameraError("unplugged")
        if self.mood == "hanging":
            time.sleep(timeout)
            raise CameraError("no frame in time")
        time.sleep(self._rng.uniform(0.1, 0.6) if self.mood == "slow" else 0.001)
        at = time.monotonic() - (1.0 if self.mood == "old" else 0.0)
        number = next(self._numbers)
        self.exposed[number] = at
        return Frame(_numbered(number), _IMAGE, at)

    def close(self) -> None:
        """Nothing to let go of."""


class Judge:
    """Passes whatever it is shown."""

    def begin(self, run: str, history: Sequence[Judged] = ()) -> Judge:
        """One for each run."""
        made = Judge()
        made.run = run
        return made

    run = ""

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        """It does not look."""

    def judge(self, trajectory: int) -> Judged:
        """A pass."""
        return Verdict(self.run, trajectory, Outcome.PASS, Route.SILENT_PASS, 1.0), {}

    def confirm(self, trajectory: int) -> None:
        """As it thought."""


class Workstation:
    """A sidecar that is started anew, on one port."""

    def __init__(self, folder: Path, rng: random.Random) -> None:
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = int(probe.getsockname()[1])
        self.url = f"http://127.0.0.1:{self.port}"
        self.camera = Camera(rng)
        self.stores = [folder / "0"]
        self._folder, self._rng = folder, rng
        self._lock = threading.Lock()
        self._running = contextlib.ExitStack()
        self.start()

    def start(self) -> None:
        """With the store of now."""
        settings = {"timeout_s": 0.4, "watch_view": False}
        config = SidecarConfig(port=self.port, data=self.stores[-1], camera=settings, audit=False)
        self._running.enter_context(running_sidecar(config, self.camera, Judge()))

    def stop(self) -> None:
        """As a service is stopped."""
        self._running.close()

    def restart(self) -> str:
        """Stop it, do what chance wants to its store, and start it. What was done."""
        with self._lock:
            self.stop()
            done = self._rng.choice(("restart", "restart", "lost store", "torn frames"))
            if done == "lost store":
                self.stores.append(self._folder / str(len(self.stores)))
            if done == "torn frames":
                self._tear()
            time.sleep(self._rng.uniform(0, 0.1))
            self.start()
            return done

    def _tear(self) -> None:
        """As a power cut leaves the frame that was written last; what was judged is settled."""
        store = Store(self.stores[-1])
        for row in store.runs():
            last = store.next_sequence(row["run"]) - 1
            captured = store.keyframe(row["run"], last)
            judged = {verdict.trajectory for verdict, _, _ in store.verdicts(row["run"])}
            if captured is not None and captured.keyframe.trajectory not in judged:
                FrameFiles(self.stores[-1]).path(row["run"], last).write_bytes(b"")
        store.close()


@dataclass
class Standing:
    """When a robot stood for a keyframe, ``time.monotonic``, s."""

    since: float
    until: float = float("inf")


@dataclass
class Robot:
    """One run, whose protocol delivers into wells and nothing else.

    Attributes:
        stood: By trajectory and kind.
        passed: Trajectories that the robot itself counts as passed.
        happened: What chance did, for the figures.
    """

    number: int
    workstation: Workstation
    rng: random.Random
    stood: dict[tuple[int, str], Standing] = field(default_factory=dict)
    passed: tuple[int, ...] = ()
    happened: Counter[str] = field(default_factory=Counter)

    def play(self) -> None:
        """Run to the end, or until a policy ends it."""
        policies = ("continue", "continue", "pause", "abort")
        name = self.rng.choice(NAMES)
        settings = Settings(
            sidecar=self.workstation.url, run_id=name, capture_timeout_s=0.35,
            verdict_timeout_s=0.5, on_fail="continue", on_undecided="continue",
            on_link_loss=self.rng.choice(policies),
        )  # fmt: skip
        watcher = Watcher(
            _context(), settings, f"{self.rng.choice('ab')}.py", text=str(self.number)
        )
        if self.rng.random() < 0.25:
            watcher._nonce = ""  # an older guard
            self.happened["older guard"] += 1
        self.happened["name given"] += name is not None
        deliveries = self.rng.randint(1, 4)
        ended: BaseException | None = None
        with _faults(self.rng, self.happened):
            try:
                watcher.begin(SimpleNamespace(lift=lambda operation: None))  # type: ignore[arg-type]
                for trajectory in range(deliveries):
                    self._deliver(watcher, trajectory)
            except AegisError as error:
                ended = error
            with contextlib.suppress(AegisError):
                watcher.end(ended)
        self.passed = watcher.result.of(Outcome.PASS)

    def _deliver(self, watcher: Watcher, trajectory: int) -> None:
        for number, kind in enumerate(KeyframeKind):
            self._chance()
            keyframe = _keyframe(watcher.run_id, self.number, trajectory, number, kind)
            standing = self.stood[trajectory, kind.value] = Standing(time.monotonic())
            try:
                watcher._perform([Capture(keyframe)])
            finally:
                # With its last keyframe the robot stands until its hold is over.
                standing.until = time.monotonic()
        watcher._perform([Hold((trajectory,), "the tip is dropped")])

    def _chance(self) -> None:
        camera = self.workstation.camera
        if camera.mood != "well" and self.rng.random() < 0.4:
            camera.mood = "well"
        elif self.rng.random() < 0.03:
            camera.mood = mood = self.rng.choice(TROUBLES)
            self.happened[f"camera {mood}"] += 1
        elif self.rng.random() < 0.015:
            self.happened[self.workstation.restart()] += 1


def _context() -> Any:
    """As much of a protocol's context as a watcher asks of it; pauses are resumed at once."""
    quiet = SimpleNamespace(comment=lambda text: None, pause=lambda text: None)
    return SimpleNamespace(
        **vars(quiet), is_simulating=lambda: False, api_version="2.15", loaded_instruments={},
        _core=SimpleNamespace(robot_type="OT-2 Standard", get_module_cores=list),
    )  # fmt: skip


def _keyframe(run: str, robot: int, trajectory: int, number: int, kind: KeyframeKind) -> Keyframe:
    return Keyframe(
        run, 4 * trajectory + number, trajectory, kind, "p300_single", "left", 1, "1:A1",
        (WellRef("r", "A1", "reservoir", "2"),),
        (WellRef("p", f"A{trajectory + 1}", "plate", "4"),),
        50.0, 50.0 if number < 2 else 0.0, 300.0, reagent=str(robot),
    )  # fmt: skip


@contextlib.contextmanager
def _faults(rng: random.Random, happened: Counter[str]) -> Iterator[None]:
    """Of this thread's link: what is lost on its way, there or back, and what comes twice."""
    _FAULTS.rng, _FAULTS.happened = rng, happened
    try:
        yield
    finally:
        _FAULTS.rng = None


_FAULTS = threading.local()
_REQUEST = SidecarClient._request


def _faulty(link: SidecarClient, *request: Any) -> dict[str, Any]:
    rng = getattr(_FAULTS, "rng", None)
    fate = 1.0 if rng is None else rng.random()
    if fate < 0.03:
        _FAULTS.happened["request lost"] += 1
        raise SidecarUnreachable("lost on its way")
    answer = _REQUEST(link, *request)
    if fate < 0.06:
        _FAULTS.happened["answer lost"] += 1
        raise SidecarUnreachable("lost on its way back")
    if fate < 0.09:
        _FAULTS.happened["sent twice"] += 1
        return _REQUEST(link, *request)
    return answer


def drawn(runs: int, seed: int, says: Callable[[str], None] = print) -> list[str]:
    """Draw so many runs.

    Returns:
        All wells that passed unseen, in words.
    """
    wrong: list[str] = []
    happened: Counter[str] = Counter()
    numbers = itertools.count()
    with mock.patch.object(SidecarClient, "_request", _faulty), _impatient():
        for first in range(0, runs, EACH):
            rng = random.Random(f"{seed} {first}")
            count = min(EACH, runs - first)
            with tempfile.TemporaryDirectory(prefix="aegis-ot-unseen-") as folder:
                wrong += _together(Path(folder), rng, count, numbers, happened)
    said = ", ".join(f"{name} {times}" for name, times in sorted(happened.items()))
    says(f"{runs} runs ({said}): {len(wrong)} wells passed unseen.")
    return wrong


def _together(
    folder: Path, rng: random.Random, count: int, numbers: Iterator[int], happened: Counter[str]
) -> list[str]:
    workstation = Workstation(folder, rng)
    robots = [Robot(next(numbers), workstation, random.Random(rng.random())) for _ in range(count)]
    waiting = list(robots)
    lock = threading.Lock()

    def work() -> None:
        while True:
            with lock:
                if not waiting:
                    return
                robot = waiting.pop()
            robot.play()

    threads = [threading.Thread(target=work) for _ in range(AT_ONCE)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    workstation.camera.mood = "well"
    seen = list(_seen(workstation))
    workstation.stop()
    for robot in robots:
        happened.update(robot.happened)
    happened["wells that the robot passed"] += sum(len(robot.passed) for robot in robots)
    happened["wells that the page passed"] += len(seen)
    return list(_unseen(workstation, robots, seen))


def _seen(workstation: Workstation) -> Iterator[tuple[str, dict[str, Any], list[int]]]:
    """Each well that the page counts as passed: its run, its entry, its frames' numbers."""
    for row in _ask(f"{workstation.url}/v1/runs")["runs"]:
        run = row["run"]
        for entry in _ask(f"{workstation.url}/v1/runs/{run}")["trajectories"]:
            if state_of(entry) in ("pass", "calibration"):
                frames = [_get(workstation.url + k["frame"]) for k in entry["keyframes"]]
                yield run, entry, [_number(frame) if frame else -1 for frame in frames]


def _unseen(
    workstation: Workstation, robots: Sequence[Robot], seen: Sequence[Any]
) -> Iterator[str]:
    exposed = workstation.camera.exposed
    counted: set[tuple[int, int]] = set()
    used: Counter[int] = Counter(number for _, _, frames in seen for number in frames)
    by_number = {robot.number: robot for robot in robots}
    for run, entry, frames in seen:
        where = f"run {run}, delivery {entry['trajectory']}"
        kinds = [keyframe["kind"] for keyframe in entry["keyframes"]]
        if kinds != [kind.value for kind in KeyframeKind]:
            yield f"{where}: passed on {kinds}"
            continue
        whose = {int(keyframe["reagent"]) for keyframe in entry["keyframes"]}
        if len(whose) != 1:
            yield f"{where}: passed on frames of robots {sorted(whose)}"
            continue
        robot = by_number[whose.pop()]
        counted.add((robot.number, entry["trajectory"]))
        for kind, number in zip(kinds, frames, strict=True):
            stood = robot.stood[entry["trajectory"], kind]
            at = exposed.get(number, -1.0)
            if used[number] > 1:
                yield f"{where}: the frame {number} is another well's, too"
            if not stood.since <= at <= stood.until:
                early, late = stood.since - at, at - stood.until
                yield f"{where}, {kind}: exposed {early:.3f} s too early or {late:.3f} s too late"
    if len(workstation.stores) == 1:
        for robot in robots:
            for trajectory in robot.passed:
                if (robot.number, trajectory) not in counted:
                    yield f"robot {robot.number} passed delivery {trajectory}, the page did not"


@contextlib.contextmanager
def _impatient() -> Iterator[None]:
    """Robots look for a lost sidecar sooner than they do in a laboratory."""
    with mock.patch.multiple(sender, _FIRST_REST_S=0.05, _LONGEST_REST_S=0.2, _CATCH_UP_S=0.3):
        yield


def _get(url: str) -> bytes:
    with _DIRECT.open(url, timeout=20) as answer:
        return bytes(answer.read())


def _ask(url: str) -> Any:
    return json.loads(_get(url))


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw and print. Returns the exit status."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.unseen", description=__doc__)
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args(arguments)
    wrong = drawn(given.runs, given.seed)
    for one in wrong:
        print(f"    {one}", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
