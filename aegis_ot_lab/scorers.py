"""All scorers by name: the package's own, and the paper's to compare them with."""

from __future__ import annotations

from collections.abc import Callable

from aegis_ot.vision import scorers
from aegis_ot.vision.types import Scorer

_COMPARED = {
    "isolation_forest": "IsolationForestScorer",
    "one_class_svm": "OneClassSvmScorer",
    "autoencoder": "AutoencoderScorer",
    "single_frame_pca": "SingleFramePcaScorer",
    "mahalanobis": "MahalanobisScorer",
}

BASELINES = ("pca", *_COMPARED)
"""The paper's scorers."""

SCORERS = (*BASELINES, *(name for name in scorers.SCORERS if name not in BASELINES))
"""Names that :func:`make_scorer` knows."""


def make_scorer(name: str) -> Scorer:
    """A new, unfitted scorer.

    Raises:
        ConfigurationError: If there is no scorer of this name.
    """
    if name not in _COMPARED:
        return scorers.make_scorer(name, SCORERS)
    from . import baselines

    make: Callable[[], Scorer] = getattr(baselines, _COMPARED[name])
    return make()
