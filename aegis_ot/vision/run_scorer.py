"""The scorer of one run: a world model from a file, or one made of the run's first wells."""

from __future__ import annotations

import copy
from collections.abc import Collection, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from ..vocabulary import KeyframeKind
from .crops import trajectory_vector
from .scorers import Calibrating, GivesPValues, WorldModel
from .scorers.pca import PcaScorer
from .tips import TIPS, tip_for
from .types import FREE, Scorer, TrajectorySample

LEAST_ALARM = 3.5
"""Score up to which a well passes in any run, for scorers in nats (p = 0.03)."""

_ADAPT_AT = (1, 2, 4, 8)
"""Numbers of the run's own normal wells at which a world model adapts to them; more change
little, and each time costs up to 100 ms."""


class RunScorer:
    """Scores the trajectories of one run.

    A world model scores from the first well on, and adapts to the run's own normal wells as
    they come. Without one, a PCA is fitted on the run's first ``wells`` normal trajectories. A
    trajectory that the PCA has learned reconstructs too well to calibrate on, so each of the
    first wells is scored by a PCA of the others (leave one out).

    Args:
        scorer: A fitted scorer, or ``None``. It is copied: runs do not see each other's wells.
        wells: Number of first wells to learn from without one.
    """

    def __init__(self, scorer: Scorer | None, wells: int) -> None:
        self._scorer: Scorer | None = copy.deepcopy(scorer)
        self._wells = max(wells, 2)
        self._vectors: list[NDArray[np.float32]] = []
        self._volumes: list[float] = []
        self._own: list[TrajectorySample] = []
        self._adapted = 0

    @property
    def name(self) -> str:
        return self._scorer.name if self._scorer is not None else PcaScorer.name

    @property
    def ready(self) -> bool:
        """Whether there is a model to score with."""
        return self._scorer is not None

    @property
    def gives_p_values(self) -> bool:
        """Whether a score is ``-log p`` of a normal well, in nats."""
        return isinstance(self._scorer, GivesPValues)

    @property
    def height_factors(self) -> Mapping[str, float]:
        """How high columns stood in the runs it was fitted on, over what the geometry says."""
        known = self._scorer.height_factors if isinstance(self._scorer, WorldModel) else {}
        return {_tip_of(name): factor for name, factor in known.items()}

    @property
    def needed(self) -> tuple[KeyframeKind, ...]:
        """Keyframes in which a tip must be found for a score to mean anything."""
        if self._adapts is not None:
            return FREE
        # A blank crop would be scored as an anomaly, and learned as normal.
        return tuple(KeyframeKind)

    def score(
        self, sample: TrajectorySample, excused: Collection[KeyframeKind] = ()
    ) -> float | None:
        """Anomaly score; ``None`` before there is a model, or without a tip it needs.

        Args:
            sample: The trajectory.
            excused: Keyframes in which the tip is on, though it could not be seen.
        """
        if self._scorer is None:
            return None
        missing = [kind for kind in self.needed if sample.detections.get(kind) is None]
        if not missing:
            return self._scorer.score(sample)
        if not isinstance(self._scorer, WorldModel) or not set(missing) <= set(excused):
            return None
        return self._scorer.score_of_seen(sample)

    def signs(self, sample: TrajectorySample) -> Mapping[str, float]:
        """What a score is made of, by sign, nats; empty if the scorer cannot say."""
        return self._scorer.signs(sample) if isinstance(self._scorer, WorldModel) else {}

    def look_ahead(self, sample: TrajectorySample) -> None:
        """Do what can be done before the last frame, while the robot moves."""
        if isinstance(self._scorer, WorldModel):
            self._scorer.look_ahead(sample)

    def accept(self, sample: TrajectorySample) -> None:
        """A well that was scored and judged normal; what was read in its frames is kept."""
        if self._adapts is not None and len(self._own) < _ADAPT_AT[-1]:
            self._own.append(sample)

    def adapt(self) -> None:
        """Adapt to the wells accepted since; costs time, so do it while the robot moves."""
        known = len(self._own)
        if self._adapts is not None and known > self._adapted and known in _ADAPT_AT:
            self._adapted = known
            self._adapts.calibrate(self._own)

    @property
    def _adapts(self) -> Calibrating | None:
        return self._scorer if isinstance(self._scorer, Calibrating) else None

    def learn(self, sample: TrajectorySample) -> Iterator[tuple[float, float]]:
        """Learn from one of the first wells; the last one yields scores and volumes of all."""
        self._vectors.append(trajectory_vector(sample))
        self._volumes.append(sample.volume_ul)
        if len(self._vectors) < self._wells:
            return
        vectors = np.stack(self._vectors)
        own = PcaScorer()
        for left_out in range(len(vectors)):
            own.fit_vectors(np.delete(vectors, left_out, axis=0))
            yield own.score_vector(vectors[left_out]), self._volumes[left_out]
        own = PcaScorer()
        own.fit_vectors(vectors)
        self._scorer = own
        self._vectors = []


def _tip_of(learned: str) -> str:
    """The tip that a model's part is of: it is kept under an OT-2 class or a Flex tip's name."""
    return learned if learned in TIPS else tip_for(learned).name
