"""The scorer of one run: a world model from a file, or one made of the run's first wells."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .crops import trajectory_vector
from .scorers.pca import PcaScorer
from .types import Scorer, TrajectorySample


class RunScorer:
    """Scores the trajectories of one run.

    Without a world model, a PCA is fitted on the run's first ``wells`` normal trajectories. A
    trajectory that the PCA has learned reconstructs too well to calibrate on, so each of the
    first wells is scored by a PCA of the others (leave one out).

    Args:
        scorer: A fitted scorer, or ``None``.
        wells: Number of first wells to learn from without one.
    """

    def __init__(self, scorer: Scorer | None, wells: int) -> None:
        self._scorer = scorer
        self._wells = max(wells, 2)
        self._vectors: list[NDArray[np.float32]] = []
        self._volumes: list[float] = []

    @property
    def name(self) -> str:
        return self._scorer.name if self._scorer is not None else PcaScorer.name

    @property
    def ready(self) -> bool:
        """Whether there is a model to score with."""
        return self._scorer is not None

    def scores(self, sample: TrajectorySample) -> dict[str, float]:
        """Scores by scorer name; none before there is a model."""
        return {} if self._scorer is None else {self.name: self._scorer.score(sample)}

    def learn(self, sample: TrajectorySample) -> Iterator[tuple[dict[str, float], float]]:
        """Learn from one of the first wells; the last one yields scores and volumes of all."""
        self._vectors.append(trajectory_vector(sample))
        self._volumes.append(sample.volume_ul)
        if len(self._vectors) < self._wells:
            return
        vectors = np.stack(self._vectors)
        own = PcaScorer()
        for left_out in range(len(vectors)):
            own.fit_vectors(np.delete(vectors, left_out, axis=0))
            yield {self.name: own.score_vector(vectors[left_out])}, self._volumes[left_out]
        own = PcaScorer()
        own.fit_vectors(vectors)
        self._scorer = own
        self._vectors = []
