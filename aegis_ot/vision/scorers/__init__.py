"""Scorers: fitted on normal trajectories, they say how unusual another one is.

:func:`make_scorer` makes one by name. One that can adapt to a run or plate is :class:`Calibrating`;
what judges live runs is a :class:`WorldModel`.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping, Sequence
from typing import Protocol, runtime_checkable

from ...errors import ConfigurationError
from ..types import Scorer, TrajectorySample

_WHERE = {
    "pca": ("pca", "PcaScorer"),
    "column": ("column", "ColumnScorer"),
    "pair": ("pair", "PairScorer"),
    "ensemble": ("ensemble", "EnsembleScorer"),
}

SCORERS = tuple(_WHERE)
"""Names that :func:`make_scorer` knows."""

__all__ = ["SCORERS", "Calibrating", "GivesPValues", "WorldModel", "make_scorer"]


@runtime_checkable
class Calibrating(Protocol):
    """A scorer that adapts to the run or plate at hand from trajectories assumed normal."""

    def calibrate(self, normals: Sequence[TrajectorySample]) -> None:
        """Adapt. Called anew for each plate; an empty sequence undoes it."""


@runtime_checkable
class GivesPValues(Scorer, Protocol):
    """A scorer whose score is ``-log p`` of a normal well, nats."""

    def p_value(self, sample: TrajectorySample) -> float:
        """How often a normal trajectory scores this high."""


@runtime_checkable
class WorldModel(GivesPValues, Calibrating, Protocol):
    """A scorer that knows what tips look like in other runs, and says what it found in this one."""

    @property
    def height_factors(self) -> Mapping[str, float]:
        """How high columns stood in the runs it was fitted on, over what the geometry says, by the
        class of tip."""

    def score_of_seen(self, sample: TrajectorySample) -> float:
        """Score of a trajectory of which a frame does not show the tip, though it is on."""

    def look_ahead(self, sample: TrajectorySample) -> None:
        """Work out what the first frames tell, while the last is still to come."""

    def signs(self, sample: TrajectorySample) -> Mapping[str, float]:
        """What a score is made of, by sign, nats."""


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
