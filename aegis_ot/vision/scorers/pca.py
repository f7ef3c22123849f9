"""The paper's world model: PCA of trajectory vectors, squared reconstruction error."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ModelError
from ..crops import VECTOR_LENGTH, trajectory_vector
from ..models import ModelFile
from ..types import TrajectorySample

Array = NDArray[np.float64]

COMPONENTS = 15
"""Number of components at the paper's variance knee (Methods, PCA; SI C)."""


class PcaScorer:
    """Squared reconstruction error of the (9216,) trajectory vector (paper, Methods).

    Fitted by singular value decomposition in double precision: with fewer samples than pixels
    the residual of a training sample is rounding noise, and in single precision that noise is
    of the order of the calibrated threshold (paper, SI C: it collapses by 1e12 from k = 15 to
    25). No more components are kept than the data hold (``n_samples - 1`` at most).

    Args:
        components: Wanted number of components, k.
    """

    name = "pca"

    def __init__(self, components: int = COMPONENTS) -> None:
        if components < 1:
            raise ValueError("a PCA needs at least one component")
        self.wanted = components
        self.mean: Array = np.empty(0)
        self.components: Array = np.empty((0, 0))
        self.variances: Array = np.empty(0)
        self.samples = 0

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        """Learn mean and components. Raises :class:`ValueError` on an empty sequence."""
        self.fit_vectors(matrix(normals))

    def fit_vectors(self, vectors: NDArray[Any]) -> None:
        """The same from a matrix, (n_samples, n_features)."""
        if len(vectors) == 0:
            raise ValueError("no normal trajectories to learn from")
        values = np.asarray(vectors, dtype=np.float64)
        self.samples = len(values)
        self.mean = values.mean(axis=0)
        _, singular, axes = np.linalg.svd(values - self.mean, full_matrices=False)
        # Directions whose singular value is rounding noise hold nothing of the data.
        floor = singular[0] * max(values.shape) * np.finfo(np.float64).eps if len(singular) else 0
        rank = int(np.sum(singular > floor))
        kept = min(self.wanted, rank)
        self.components = axes[:kept]
        self.variances = singular**2 / max(len(values) - 1, 1)

    @property
    def explained(self) -> Array:
        """Cumulative fraction of variance by component, (n_components,)."""
        total = self.variances.sum()
        if total == 0:
            return np.ones(len(self.variances))
        return np.asarray(np.cumsum(self.variances) / total)

    def score(self, sample: TrajectorySample) -> float:
        """Squared distance to the plane of normals, grey levels squared (0 to 1 each)."""
        return self.score_vector(trajectory_vector(sample))

    def score_vector(self, vector: NDArray[Any]) -> float:
        """The same for one vector, (n_features,)."""
        if self.mean.size == 0:
            raise ValueError("the PCA scorer was not fitted")
        centred = np.asarray(vector, dtype=np.float64) - self.mean
        residual = centred - self.components.T @ (self.components @ centred)
        return float(residual @ residual)

    def to_arrays(self) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
        """Arrays and settings for a model file. Single precision: see :meth:`from_model`."""
        arrays: dict[str, NDArray[Any]] = {
            "mean": self.mean.astype(np.float32),
            "components": self.components.astype(np.float32),
            "variances": self.variances,
        }
        return arrays, {"components": self.wanted, "samples": self.samples}

    @classmethod
    def from_model(cls, model: ModelFile) -> PcaScorer:
        """A scorer from a model file.

        Stored components are single precision, which leaves them orthogonal to about 1e-7;
        they are made orthonormal again, or a long vector would not project cleanly.

        Raises:
            ModelError: If arrays are missing or their shapes do not fit.
        """
        arrays: Mapping[str, NDArray[Any]] = model.arrays
        try:
            mean = np.asarray(arrays["mean"], dtype=np.float64)
            components = np.asarray(arrays["components"], dtype=np.float64)
            variances = np.asarray(arrays["variances"], dtype=np.float64)
            scorer = cls(int(model.settings["components"]))
            scorer.samples = int(model.settings["samples"])
        except (KeyError, TypeError, ValueError) as error:
            raise ModelError(f"the PCA model lacks or garbles {error}; fit it anew") from error
        if mean.shape != (VECTOR_LENGTH,) or components.shape[1:] != mean.shape:
            raise ModelError(
                f"the PCA model is for vectors of length {mean.size}, this package makes "
                f"{VECTOR_LENGTH}; fit it anew"
            )
        scorer.mean, scorer.variances = mean, variances
        scorer.components = np.linalg.qr(components.T)[0].T if len(components) else components
        return scorer


def matrix(samples: Sequence[TrajectorySample]) -> NDArray[np.float32]:
    """Trajectory vectors of several samples, (n_samples, 9216).

    Raises:
        ValueError: On an empty sequence.
    """
    if not samples:
        raise ValueError("no normal trajectories to learn from")
    return np.stack([trajectory_vector(sample) for sample in samples])
