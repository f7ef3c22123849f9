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

REPETITIONS = 7
TARGET = 1.15


def figures() -> Iterator[Figure]:
    """Guarded over unguarded processor time, without and with helper functions to watch."""
    for helper in (False, True):
        texts = [plate_protocol(guarded=guarded, helper=helper) for guarded in (False, True)]
        times = measure({
            "plain": lambda: simulate(texts[0]),  # noqa: B023
            "guarded": lambda: simulate(texts[1]),  # noqa: B023
        })  # fmt: skip
        ratio = statistics.median(times["guarded"]) / statistics.median(times["plain"])
        fastest = min(times["guarded"]) / min(times["plain"])
        kind = "protocol with a helper function" if helper else "run() only"
        yield Figure(
            f"guard overhead: guarded / unguarded, {kind}",
            f"96 wells, {COMMANDS} commands, apiLevel 2.20, opentrons.simulate", "simulator",
            ratio, "x", TARGET,
            note=f"median of {REPETITIONS} runs in turns; ratio of the fastest ones {fastest:.3f}",
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
        for _ in range(repetitions):
            for name, run in cases.items():
                gc.collect()
                begun = time.process_time()
                run()
                times[name].append(time.process_time() - begun)
        return times
    finally:
        logging.disable(logging.NOTSET)
