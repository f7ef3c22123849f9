"""The trajectories that the vision benchmarks look at."""

from __future__ import annotations

import contextlib
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

SIZE = (960, 540)


@contextlib.contextmanager
def folders(given: Sequence[Path]) -> Iterator[list[Path]]:
    """The given data sets, or one of simulated frames that is made for the occasion."""
    if given:
        yield list(given)
        return
    from aegis_ot_lab.drawing import write_dataset

    with tempfile.TemporaryDirectory() as place:
        yield [write_dataset(Path(place) / "p1000", plates=16, seed=2026, size=SIZE)]


def label(source: str) -> str:
    """What results on a data set are called."""
    return "simulated" if source == "synthetic" else source
