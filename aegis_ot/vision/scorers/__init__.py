"""Scorers: fitted on normal trajectories, they say how unusual another one is.

:func:`make_scorer` makes one by name. A scorer that can adapt to a run or plate has a further
method, see :class:`Calibrating`.
"""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from typing import Protocol, runtime_checkable

from ...errors import ConfigurationError
from ..types import Scorer, TrajectorySample

_WHERE = {
    "pca": ("pca", "PcaScorer"),
    "column": ("column", "ColumnScorer"),
    "patches": ("patches", "PatchesScorer"),
    "ensemble": ("ensemble", "EnsembleScorer"),
}

SCORERS = tuple(_WHERE)
"""Names that :func:`make_scorer` knows."""

__all__ = ["SCORERS", "Calibrating", "make_scorer", "signs_of"]


@runtime_checkable
class Calibrating(Protocol):
    """A scorer that adapts to the run or plate at hand from trajectories assumed normal."""

    def calibrate(self, normals: Sequence[TrajectorySample]) -> None:
        """Adapt. Called anew for each plate; an empty sequence undoes it."""


def make_scorer(name: str, known: Sequence[str] = SCORERS) -> Scorer:
    """A new, unfitted scorer.

    Args:
        name: One of :data:`SCORERS`.
        known: What a complaint names.

    Raises:
        ConfigurationError: If there is no scorer of this name.
    """
    try:
        module, cls = _WHERE[name]
    except KeyError:
        raise ConfigurationError(
            f"there is no scorer {name!r}; choose one of {', '.join(known)}"
        ) from None
    try:
        loaded = importlib.import_module(f".{module}", __name__)
    except ModuleNotFoundError as error:
        raise ConfigurationError(f"scorer {name!r} cannot be loaded: {error}") from error
    scorer: Scorer = getattr(loaded, cls)()
    return scorer


def signs_of(scorer: Scorer, sample: TrajectorySample) -> dict[str, float]:
    """Surprises of the signs behind a score, by sign, nats; none where the scorer has no report."""
    read = getattr(scorer, "report", None)
    report = None if read is None else read(sample)
    column = getattr(report, "column", report)
    signs = {str(sign): float(value) for sign, value in getattr(column, "surprises", {}).items()}
    patches = getattr(report, "patches", None)
    return signs if patches is None else signs | {"patches": float(patches)}
