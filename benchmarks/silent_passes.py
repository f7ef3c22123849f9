"""Simulated runs in which all that is wrong looks alike, and cameras that show nothing.

Part of ``python -m benchmarks.live_runs``. A run counts as held if it stops before anything passes
that should not: at a failed or undecided well, at a question, or at a view that tells nothing.
"""

from __future__ import annotations

import sys
import time
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import islice
from typing import Any

from .live_runs import FAULTS, Run, is_question, keyframes_of, session_of

WELLS = 24
DRIFT = tuple(range(100, 0, -5))
"""Percent delivered, well by well, of a failure that drifts in."""

DRIFTED = 60
"""Percent delivered at which such a run must have been held."""

CAMERA_FROM = (0, 5, 7)
"""Keyframes from which the camera shows nothing: the run's first, and two of its second well."""


def measure(
    runs: Sequence[Run], progress: bool = False, faults: bool = True, cameras: bool = True
) -> dict[str, Any]:
    """What was held, and what passed in silence, by case."""
    cases: dict[str, Callable[[Run], str]] = {}
    if faults:
        cases = {f"all wells {fault}": _all_wells(fault) for fault in FAULTS}
        cases["two faults in the first six"] = _among_the_first
        cases[f"drift to {DRIFTED} % delivered"] = _drifting
    if cameras:
        cases["sound camera held"] = lambda run: camera_trial(run, "none", 0)
        for spoiled in _views():
            cases[f"camera {spoiled}"] = _camera(spoiled)
    passed: dict[str, list[str]] = defaultdict(list)
    tried: dict[str, int] = defaultdict(int)
    for number, run in enumerate(runs):
        begun = time.monotonic()
        for case, trial in cases.items():
            tried[case] += 1
            wrong = trial(run)
            if wrong:
                passed[case].append(f"{run}: {wrong}")
        if progress:
            took = time.monotonic() - begun
            wrong = sum(map(len, passed.values()))
            sys.stderr.write(
                f"silent passes, run {number + 1} of {len(runs)}: {took:.0f} s, {wrong} wrong\n"
            )
    return {
        "frames": "simulated",
        "cases": [
            {"case": case, "tried": tried[case], "wrong": passed[case]} for case in tried
        ],
    }  # fmt: skip


def show(found: dict[str, Any]) -> str:
    """As text."""
    lines = [
        "Runs on simulated frames in which all that is wrong looks alike, and cameras that show "
        "nothing: tried, and passed in silence"
    ]
    for row in found["cases"]:
        late = sum(": held at well" in run for run in row["wrong"])
        told = f", of which {late} were held later" if late else ""
        lines.append(f"{row['case']:32} {row['tried']:5} {len(row['wrong']):5}{told}")
    lines += [f"{row['case']}: {run}" for row in found["cases"] for run in row["wrong"]]
    return "\n".join(lines) + "\n"


def _verdicts(run: Run, faults: Sequence[str], wells: int) -> Iterator[Any]:
    """Verdicts of a run whose operator finds sound wells right."""
    from aegis_ot.sidecar import make_analyser
    from aegis_ot.simulation import SimulatedCamera

    struck = {fault.rpartition("#")[2] for fault in faults}
    camera = SimulatedCamera(run.seed, faults, session_of(run))
    analyser: Any = make_analyser(detector=_detector()).begin("run")
    for number, keyframes in enumerate(keyframes_of(run, wells)):
        for keyframe in keyframes:
            camera.announce(keyframe)
            analyser.observe(keyframe, camera.frame_after(0.0, 5.0))
        verdict = analyser.judge(number)[0]
        yield verdict
        if is_question(verdict) and str(number + 1) not in struck:
            analyser.confirm(number)


def _all_wells(fault: str) -> Callable[[Run], str]:
    def trial(run: Run) -> str:
        faults = [f"{fault}@#{number}" for number in range(1, WELLS + 1)]
        for number, verdict in enumerate(_verdicts(run, faults, WELLS)):
            if verdict.outcome.value != "pass":
                return f"held at well {number + 1} only" if number else ""
        return f"all {WELLS} wells passed"

    return trial


def _among_the_first(run: Run) -> str:
    """Two of a liquid's first six wells go wrong; each must be held."""
    kinds = FAULTS[run.seed % len(FAULTS)], FAULTS[(run.seed // 7 + 3) % len(FAULTS)]
    first = 1 + run.seed % 3
    places = (first, first + 1 + run.seed % 3)
    faults = [f"{kind}@#{place}" for kind, place in zip(kinds, places, strict=True)]
    verdicts = list(_verdicts(run, faults, 6))
    missed = [
        fault for fault, place in zip(faults, places, strict=True)
        if verdicts[place - 1].outcome.value == "pass"
    ]  # fmt: skip
    return f"passed {', '.join(missed)}" if missed else ""


def _drifting(run: Run) -> str:
    faults = [f"partial:{share}@#{n + 1}" for n, share in enumerate(DRIFT) if share < 100]
    last = DRIFT.index(DRIFTED)
    # Whoever is asked about the first well, which is sound, says so.
    for number, verdict in enumerate(islice(_verdicts(run, faults, len(DRIFT)), last + 1)):
        if verdict.outcome.value != "pass" and not (number == 0 and is_question(verdict)):
            return ""
    return f"passed down to {DRIFTED} % delivered"


def _camera(spoiled: str) -> Callable[[Run], str]:
    def trial(run: Run) -> str:
        start = CAMERA_FROM[run.seed % len(CAMERA_FROM)]
        wrong = camera_trial(run, spoiled, start)
        return f"from keyframe {start}: {wrong}" if wrong else ""

    return trial


def camera_trial(run: Run, spoiled: str, start: int) -> str:
    """What is wrong with what the view's watch says: empty if it says what it should.

    Args:
        run: Whose frames are spoiled.
        spoiled: How: ``"none"``, or one of the views below.
        start: Keyframe from which they are.
    """
    from aegis_ot.vision.view import ViewWatch

    shots, turned, spoil = _shots(run), _shots(run, turned=True), _views().get(spoiled)
    watch = ViewWatch(_detector())
    before = None
    for number in range(len(shots.keyframes) if spoil is None else 12):
        bad = spoil is not None and number >= start
        for exposure in range(2):
            source = turned if bad and spoiled == "misaimed" else shots
            image = source.image(number, exposure)
            if bad and spoil is not None:
                frozen = spoiled == "frozen" and before is not None
                image = before if frozen else spoil(image, number)
            trouble = watch.look(shots.keyframes[number], image, again=exposure == 0)
            if trouble is None:
                break
        before = image
        if trouble is not None and not bad:
            return f"held at sound keyframe {number}: {trouble.kind.value}"
        if trouble is not None:
            named = trouble.kind.value == spoiled
            return "" if named else f"called {trouble.kind.value}"
        # A frozen camera shows itself with its second picture.
        if bad and number - start >= (2 if spoiled == "frozen" and start == 0 else 1):
            return "not noticed within two keyframes"
    return ""


class _Shots:
    """Frames of one run, each rendered once."""

    def __init__(self, run: Run, turned: bool) -> None:
        from aegis_ot.simulation import SimulatedCamera

        session = session_of(run)
        if turned:
            session = replace(session, look=(0.0, 0.0, 230.0))
        self.keyframes = [k for well in keyframes_of(run, 6) for k in well]
        self._camera = SimulatedCamera(run.seed, (), session)
        self._known: dict[tuple[int, int], Any] = {}

    def image(self, number: int, exposure: int) -> Any:
        """The frame of a keyframe, or another exposure of it."""
        if (number, exposure) not in self._known:
            self._camera.announce(self.keyframes[number])
            for _ in range(exposure + 1):
                frame = self._camera.frame_after(0.0, 5.0)
            self._known[number, exposure] = frame.image
        return self._known[number, exposure]


@lru_cache(maxsize=2)
def _shots(run: Run, turned: bool = False) -> _Shots:
    return _Shots(run, turned)


@lru_cache(maxsize=1)
def _detector() -> Any:
    from aegis_ot.sidecar import make_detector

    return make_detector()


def _views() -> dict[str, Callable[[Any, int], Any]]:
    import cv2
    import numpy as np

    def noisy(image: Any, seed: int) -> Any:
        spread = np.random.default_rng(seed).normal(0.0, 2.0, image.shape)
        return np.clip(image + spread, 0, 255).astype(np.uint8)

    def blurred(image: Any, px: float) -> Any:
        """By so many px of a frame of 480 lines."""
        return cv2.GaussianBlur(image, (0, 0), px * image.shape[0] / 480.0)

    return {
        "frozen": lambda image, seed: image,
        "misaimed": lambda image, seed: image,
        "dark": lambda image, seed: noisy(image * 0.03, seed),
        "covered": lambda image, seed: noisy(blurred(image, 60.0) * 0.5, seed),
        "blown_out": lambda image, seed: noisy(image * 15.0, seed),
        "blurred": lambda image, seed: noisy(blurred(image, 6.0), seed),
    }
