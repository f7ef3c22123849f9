"""What the guard adds to a simulation, without a camera: Layer 1's recording and judging."""

from __future__ import annotations

import gc
import logging
import statistics
import time
from collections.abc import Callable, Iterator
from io import StringIO

from .figure import Figure
from .protocols import COMMANDS, plate_protocol

REPETITIONS = 11
TARGET = 1.15


def figures() -> Iterator[Figure]:
    """Guarded over unguarded processor time, without and with helper functions to watch."""
    for helper in (False, True):
        texts = [plate_protocol(guarded=guarded, helper=helper) for guarded in (False, True)]
        times = measure({
            "plain": lambda: simulate(texts[0]),  # noqa: B023
            "guarded": lambda: simulate(texts[1]),  # noqa: B023
        })  # fmt: skip
        pairs = zip(times["guarded"], times["plain"], strict=True)
        ratios = sorted(guarded / plain for guarded, plain in pairs)
        ratio = statistics.median(ratios)
        fastest = min(times["guarded"]) / min(times["plain"])
        kind = "protocol with a helper function" if helper else "run() only"
        yield Figure(
            f"guard overhead: guarded / unguarded, {kind}",
            f"96 wells, {COMMANDS} commands, apiLevel 2.20, opentrons.simulate", "simulator",
            ratio, "x", TARGET,
            note=f"median of {REPETITIONS} pairs run one after the other, {ratios[0]:.3f} to "
            f"{ratios[-1]:.3f}; ratio of the fastest runs {fastest:.3f}",
        )  # fmt: skip


def simulate(text: str) -> None:
    """Run a protocol's text in Opentrons' simulator."""
    from opentrons.simulate import simulate as run

    run(StringIO(text), "bench_protocol.py")


def measure(
    cases: dict[str, Callable[[], object]], repetitions: int = REPETITIONS
) -> dict[str, list[float]]:
    """Processor time of each case, s, in turns, so that a busy machine is fair to all."""
    logging.disable(logging.WARNING)
    try:
        for run in cases.values():
            run()  # warm caches are part of any second run
        times: dict[str, list[float]] = {name: [] for name in cases}
        for turn in range(repetitions):
            # Each second turn the other way round: what comes later meets a warmer machine.
            for name, run in list(cases.items())[:: 1 if turn % 2 == 0 else -1]:
                gc.collect()
                begun = time.process_time()
                run()
                times[name].append(time.process_time() - begun)
        return times
    finally:
        logging.disable(logging.NOTSET)
