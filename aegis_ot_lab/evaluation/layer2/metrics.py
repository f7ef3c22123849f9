"""Detection metrics with well-level bootstrap intervals."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import rankdata

Scores = NDArray[np.float64]
Flags = NDArray[np.bool_]
Metric = Callable[[Flags, Scores, Flags], float]


@dataclass(frozen=True)
class Interval:
    """A figure with its 95 % interval; ``nan`` where it is not defined."""

    value: float
    low: float
    high: float

    def to_json(self) -> dict[str, float | None]:
        """``{"value", "low", "high"}``; undefined figures are ``None``."""
        return {
            name: None if np.isnan(number) else round(float(number), 6)
            for name, number in (("value", self.value), ("low", self.low), ("high", self.high))
        }

    def __str__(self) -> str:
        if np.isnan(self.value):
            return "not defined"
        return f"{self.value:.3f} [{self.low:.3f}, {self.high:.3f}]"


def average_precision(failed: Flags, scores: Scores, flagged: Flags) -> float:
    """Area under the precision-recall curve, as a step function; tied wells enter together."""
    if not failed.any():
        return float("nan")
    order = np.argsort(-scores, kind="stable")
    hits = np.cumsum(failed[order])
    last_of_tie = np.append(np.diff(scores[order]) != 0, True)
    hits, taken = hits[last_of_tie], np.flatnonzero(last_of_tie) + 1
    gained = np.diff(hits, prepend=0) / hits[-1]
    return float(np.sum(gained * hits / taken))


def auroc(failed: Flags, scores: Scores, flagged: Flags) -> float:
    """Area under the ROC curve; ties count half."""
    bad = int(failed.sum())
    good = len(failed) - bad
    if not bad or not good:
        return float("nan")
    ranks = rankdata(scores)
    return float((ranks[failed].sum() - bad * (bad + 1) / 2) / (bad * good))


def precision(failed: Flags, scores: Scores, flagged: Flags) -> float:
    """Of the flagged wells, how many failed; undefined if none was flagged."""
    return float(failed[flagged].mean()) if flagged.any() else float("nan")


def recall(failed: Flags, scores: Scores, flagged: Flags) -> float:
    """Of the failed wells, how many were flagged."""
    return float(flagged[failed].mean()) if failed.any() else float("nan")


def f1(failed: Flags, scores: Scores, flagged: Flags) -> float:
    """Harmonic mean of precision and recall: 2 TP / (2 TP + FP + FN)."""
    hits = int((failed & flagged).sum())
    wrong = int((failed != flagged).sum())
    return 2 * hits / (2 * hits + wrong) if hits + wrong else float("nan")


METRICS: Mapping[str, Metric] = {
    "average_precision": average_precision,
    "auroc": auroc,
    "f1": f1,
    "precision": precision,
    "recall": recall,
}


def bootstrap(
    failed: Flags, scores: Scores, flagged: Flags, *, resamples: int = 2000, seed: int = 0
) -> dict[str, Interval]:
    """All metrics with percentile intervals over resampled wells.

    Args:
        failed: (n_wells,) truth.
        scores: (n_wells,) larger is worse, comparable between plates.
        flagged: (n_wells,) decision at the operating point.
        resamples: Number of bootstrap samples.
        seed: Of the resampling.
    """
    rng = np.random.default_rng(seed)
    values: dict[str, list[float]] = {name: [] for name in METRICS}
    for _ in range(resamples if len(failed) else 0):
        drawn = rng.integers(0, len(failed), len(failed))
        for name, metric in METRICS.items():
            value = metric(failed[drawn], scores[drawn], flagged[drawn])
            if not np.isnan(value):
                values[name].append(value)
    intervals = {}
    for name, metric in METRICS.items():
        value = metric(failed, scores, flagged) if len(failed) else float("nan")
        low, high = np.percentile(values[name], [2.5, 97.5]) if values[name] else (np.nan, np.nan)
        intervals[name] = Interval(value, float(low), float(high))
    return intervals
