"""Guarded over unguarded simulation, verdict included, on protocols as people write them.

Each protocol is simulated both ways in one process, in turns. Without a folder it is those that
ship in ``examples/``; ``python -m benchmarks --only protocols --protocols FOLDER`` takes every file
below a folder that has a ``def run(`` and can be simulated as it is.
"""

from __future__ import annotations

import contextlib
import gc
import logging
import re
import statistics
import time
from collections.abc import Iterator
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from unittest import mock

from .figure import Figure

TARGET_MEDIAN = 1.2
TARGET_P95 = 1.5

_LEAST, _MOST, _ENOUGH_S = 3, 10, 0.5
"""Pairs of runs of each protocol: short ones are repeated until they took so long in all."""
_LONGEST_S = 20.0
"""Protocols whose simulation takes longer are left out."""

_RUN = re.compile(r"^def run\(", re.MULTILINE)
_EXAMPLES = Path(__file__).resolve().parent.parent / "examples"


@dataclass(frozen=True)
class Ratios:
    """Of one protocol; ratios of the fastest runs, since a busy machine only ever adds.

    Attributes:
        path: Its file.
        plain_s: Unguarded simulation, s.
        guarded: Guarded over unguarded.
        recording: Likewise, without the time that the verdict took.
    """

    path: Path
    plain_s: float
    guarded: float
    recording: float


def figures(folders: list[Path]) -> Iterator[Figure]:
    """Median and 95th percentile over the protocols of the examples, or of a user's folders."""
    found = list(measured(folders or [_EXAMPLES]))
    if len(found) < 2:
        print("  fewer than two protocols there can be simulated as they are")
        return
    data = f"{len(found)} protocols, opentrons.simulate, fastest of {_LEAST} to {_MOST} runs each"
    whole = [one.guarded for one in found]
    part = [one.recording for one in found]
    what = "guarded / unguarded, verdict included"
    yield Figure(f"{what}, median", data, "simulator", statistics.median(whole), "x", TARGET_MEDIAN)
    worst = sorted(found, key=lambda one: -one.guarded)[:3]
    note = ", ".join(f"{one.path.name} {one.guarded:.2f} ({one.plain_s:.2f} s)" for one in worst)
    yield Figure(
        f"{what}, 95th percentile", data, "simulator", _percentile(whole, 95), "x", TARGET_P95,
        note=f"dearest: {note}",
    )  # fmt: skip
    what = "  of it tap, recording and names"
    yield Figure(f"{what}, median", data, "simulator", statistics.median(part), "x")
    yield Figure(f"{what}, 95th percentile", data, "simulator", _percentile(part, 95), "x")


def measured(folders: list[Path]) -> Iterator[Ratios]:
    """The ratios of every protocol below these folders that simulates."""
    paths = sorted({path for folder in folders for path in folder.rglob("*.py")})
    logging.disable(logging.CRITICAL)
    try:
        for path in paths:
            text = path.read_text(encoding="utf-8", errors="replace")
            if _RUN.search(text) and "aegis_ot" not in text:
                ratios = ratios_of(path, text)
                if ratios is not None:
                    yield ratios
    finally:
        logging.disable(logging.NOTSET)


def ratios_of(path: Path, text: str) -> Ratios | None:
    """Measure one protocol; ``None`` if it cannot be simulated, or takes too long."""
    guarded = _RUN.sub("from aegis_ot import guard\n@guard(rules='warn')\ndef run(", text, count=1)
    plain: list[float] = []
    whole: list[float] = []
    recording: list[float] = []
    try:
        with contextlib.redirect_stdout(StringIO()):
            if _timed(path, text)[0] > _LONGEST_S:
                return None
            _timed(path, guarded)  # warm caches are part of any second run
            while len(plain) < _LEAST or (sum(plain) < _ENOUGH_S and len(plain) < _MOST):
                plain.append(_timed(path, text)[0])
                taken, verdict = _timed(path, guarded)
                whole.append(taken)
                recording.append(taken - verdict)
    except Exception:  # custom labware, a file of its own, another API: no fault of the guard
        return None
    fastest = min(plain)
    return Ratios(path, fastest, min(whole) / fastest, min(recording) / fastest)


def _timed(path: Path, text: str) -> tuple[float, float]:
    """Processor time of a simulation and, of it, of the verdict, s."""
    from opentrons.simulate import simulate

    from aegis_ot import judged_run

    verdicts = [0.0]
    judge = judged_run._judge

    def timed_judge(*args: object) -> object:
        begun = time.process_time()
        try:
            return judge(*args)  # type: ignore[arg-type]
        finally:
            verdicts.append(time.process_time() - begun)

    gc.collect()
    with mock.patch.object(judged_run, "_judge", timed_judge):
        begun = time.process_time()
        simulate(StringIO(text), path.name)
        return time.process_time() - begun, sum(verdicts)


def _percentile(values: list[float], percent: int) -> float:
    return statistics.quantiles(values, n=100, method="inclusive")[percent - 1]
