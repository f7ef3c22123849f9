"""The paper's other scorers, for comparison (paper, SI B): all work on trajectory vectors.

The paper does not give their settings; these are the libraries' usual ones on standardised
PCA features or raw vectors, as said at each class, with fixed seeds.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from sklearn.ensemble import IsolationForest
from sklearn.exceptions import ConvergenceWarning
from sklearn.neural_network import MLPRegressor
from sklearn.svm import OneClassSVM

from aegis_ot.vision.crops import CANVAS, trajectory_vector
from aegis_ot.vision.scorers.pca import COMPONENTS, PcaScorer, matrix
from aegis_ot.vision.types import TrajectorySample
from aegis_ot.vocabulary import KeyframeKind

Array = NDArray[np.float64]


class IsolationForestScorer:
    """Isolation forest on trajectory vectors; the score is the library's, from 0 to 1."""

    name = "isolation_forest"

    def __init__(self, trees: int = 100, seed: int = 0) -> None:
        self._forest = IsolationForest(n_estimators=trees, random_state=seed, max_features=0.05)

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        self._forest.fit(matrix(normals))

    def score(self, sample: TrajectorySample) -> float:
        return float(-self._forest.score_samples(trajectory_vector(sample)[None])[0])


class OneClassSvmScorer:
    """One-class SVM, radial kernel, nu = 0.1, on trajectory vectors.

    The score is exp(-decision), so that it is positive and rises with the distance outside.
    """

    name = "one_class_svm"

    def __init__(self, nu: float = 0.1) -> None:
        self._svm = OneClassSVM(kernel="rbf", gamma="scale", nu=nu)

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        self._svm.fit(matrix(normals))

    def score(self, sample: TrajectorySample) -> float:
        return float(np.exp(-self._svm.decision_function(trajectory_vector(sample)[None])[0]))


class AutoencoderScorer:
    """Dense autoencoder, 9216-64-15-64-9216, squared reconstruction error.

    The first and last layers are fixed to the leading principal axes of the normals (at most
    64), so that what is trained is small enough for a few dozen samples.
    """

    name = "autoencoder"

    def __init__(self, bottleneck: int = COMPONENTS, seed: int = 0) -> None:
        self._bottleneck, self._seed = bottleneck, seed
        self._axes = PcaScorer(64)
        self._scale: Array = np.ones(1)
        self._network: Any = None

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        vectors = matrix(normals).astype(np.float64)
        self._axes.fit_vectors(vectors)
        latent = (vectors - self._axes.mean) @ self._axes.components.T
        self._network = None
        if latent.shape[1] == 0:
            return
        self._scale = np.array([latent.std() or 1.0])
        self._network = MLPRegressor(
            hidden_layer_sizes=(64, self._bottleneck, 64),
            activation="tanh",
            alpha=1e-4,
            max_iter=300,
            random_state=self._seed,
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ConvergenceWarning)
            target = latent / self._scale
            self._network.fit(target, target.ravel() if target.shape[1] == 1 else target)

    def score(self, sample: TrajectorySample) -> float:
        vector = trajectory_vector(sample).astype(np.float64) - self._axes.mean
        if self._network is None:
            return float(vector @ vector)
        latent = self._axes.components @ vector
        predicted = np.ravel(self._network.predict((latent / self._scale)[None])) * self._scale
        residual = vector - self._axes.components.T @ predicted
        return float(residual @ residual)


class SingleFramePcaScorer(PcaScorer):
    """PCA of the POST_DISPENSE crop alone, (2304,)."""

    name = "single_frame_pca"

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        self.fit_vectors(_last_frame(matrix(normals)))

    def score(self, sample: TrajectorySample) -> float:
        return self.score_vector(_last_frame(trajectory_vector(sample)))


class MahalanobisScorer(PcaScorer):
    """Squared Mahalanobis distance in the 15-dimensional PCA space."""

    name = "mahalanobis"

    def score(self, sample: TrajectorySample) -> float:
        if self.mean.size == 0:
            raise ValueError("the Mahalanobis scorer was not fitted")
        vector = trajectory_vector(sample).astype(np.float64) - self.mean
        latent = self.components @ vector
        variances = self.variances[: len(latent)]
        return float(np.sum(latent**2 / variances)) if len(latent) else float(vector @ vector)


def _last_frame(vectors: NDArray[np.float32]) -> NDArray[np.float32]:
    start = list(KeyframeKind).index(KeyframeKind.POST_DISPENSE) * CANVAS * CANVAS
    return vectors[..., start : start + CANVAS * CANVAS]
