"""What the hash chain of a run adds to each record, and what its lineage takes."""

from __future__ import annotations

import os
import statistics
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from aegis_ot.sidecar.lineage import write_lineage
from aegis_ot.sidecar.store import Captured, Store
from aegis_ot.sidecar.wire import RunStart
from aegis_ot.vocabulary import Keyframe, KeyframeKind, Outcome, Route, Verdict, WellRef

from .figure import Figure

RECORDS, TURNS = 300, 9
TARGET_MS = 1.0
TARGET_LINEAGE_MS = 2000.0


def figures() -> Iterator[Figure]:
    """Both."""
    yield from _chain()
    yield _lineage()


def _lineage() -> Figure:
    """A 96-well plate with its 384 frames, written as a folder to file."""
    jpeg, wells = os.urandom(60_000), [f"{row}{n}" for row in "ABCDEFGH" for n in range(1, 13)]
    with tempfile.TemporaryDirectory() as folder:
        store = Store(Path(folder))
        store.register(RunStart(run="plate"))
        for sequence in range(4 * len(wells)):
            well = WellRef("p", wells[sequence // 4], "plate", "4")
            keyframe = Keyframe(
                "plate", sequence, sequence // 4, tuple(KeyframeKind)[sequence % 4],
                "p300_single_gen2", "left", 1, "1:A1", (WellRef("r", "A1"),), (well,), 100.0,
                100.0, 300.0,
            )  # fmt: skip
            store.add_keyframe(Captured(keyframe, 0.01, time.time()), jpeg)
        _fill(store, "plate", 0)
        begun = time.process_time()
        write_lineage(store, "plate", Path(folder) / "out")
        took = time.process_time() - begun
        store.close()
    return Figure("lineage of a 96-well run, 384 frames with it", "processor time", "", took * 1e3,
                  "ms", TARGET_LINEAGE_MS)  # fmt: skip


def _chain() -> Iterator[Figure]:
    """Verdicts into a store with and without a chain, in turns."""
    with tempfile.TemporaryDirectory() as folder:
        store = Store(Path(folder), alone=True)
        store.register(RunStart(run="chained"))
        store.register(RunStart(run="bare"))
        store._db.execute("DELETE FROM chain WHERE run = 'bare'")  # as an older run
        took: dict[str, list[float]] = {"chained": [], "bare": []}
        for turn in range(TURNS):
            for run, times in took.items():
                times.append(_fill(store, run, turn * RECORDS) / RECORDS)
        store.close()
    added = [one - other for one, other in zip(*took.values(), strict=True)]
    ratio = [one / other for one, other in zip(*took.values(), strict=True)]
    data = f"{RECORDS} verdicts, median of {TURNS} turns, processor time"
    yield Figure("chain and signature, added to a record", data, "", statistics.median(added) * 1e3,
                 "ms", TARGET_MS)  # fmt: skip
    yield Figure("  a record with it, beside one without", data, "", statistics.median(ratio), "x")


def _fill(store: Store, run: str, first: int) -> float:
    verdicts = [
        Verdict(run, first + number, Outcome.PASS, Route.SILENT_PASS) for number in range(RECORDS)
    ]
    begun = time.process_time()
    for verdict in verdicts:
        store.add_verdict(verdict, {"boxes": {"aspirate": [1.0, 2.0, 30.0, 40.0]}})
    return time.process_time() - begun
