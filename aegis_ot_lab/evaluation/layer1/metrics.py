"""Precision, recall and F1 over protocols, with seeded bootstrap intervals."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass

RESAMPLES = 2000

Outcome = tuple[bool, bool]
"""(should be flagged, was taken for bad)."""


@dataclass(frozen=True)
class BootstrapInterval:
    """A figure with its 95 % bootstrap interval; ``None`` where it is not defined."""

    value: float | None
    low: float | None
    high: float | None

    def to_json(self) -> dict[str, float | None]:
        """As plain values."""
        return {"value": self.value, "low": self.low, "high": self.high}

    def __str__(self) -> str:
        if self.value is None or self.low is None or self.high is None:
            return "not defined"
        return f"{self.value:.3f} [{self.low:.3f}, {self.high:.3f}]"


@dataclass(frozen=True)
class Scores:
    """Protocol-level scores.

    Attributes:
        true_positives: Bad protocols flagged.
        false_positives: Correct protocols flagged.
        false_negatives: Bad protocols not flagged.
        true_negatives: Correct protocols not flagged.
    """

    true_positives: int
    false_positives: int
    false_negatives: int
    true_negatives: int
    precision: BootstrapInterval
    recall: BootstrapInterval
    f1: BootstrapInterval


def score(outcomes: Sequence[Outcome], seed: int = 0, resamples: int = RESAMPLES) -> Scores:
    """Score protocols.

    Args:
        outcomes: One per protocol.
        seed: Of the resampling.
        resamples: Number of bootstrap samples (protocols drawn with replacement).
    """
    rng = random.Random(seed)
    samples = [
        _counts([outcomes[rng.randrange(len(outcomes))] for _ in outcomes])
        for _ in range(resamples if outcomes else 0)
    ]
    counts = _counts(outcomes)
    return Scores(
        *counts,
        precision=_interval(_precision, counts, samples),
        recall=_interval(_recall, counts, samples),
        f1=_interval(_f1, counts, samples),
    )


Counts = tuple[int, int, int, int]


def _counts(outcomes: Sequence[Outcome]) -> Counts:
    return (
        outcomes.count((True, True)),
        outcomes.count((False, True)),
        outcomes.count((True, False)),
        outcomes.count((False, False)),
    )


def _precision(counts: Counts) -> float | None:
    true, false, _, _ = counts
    return true / (true + false) if true + false else None


def _recall(counts: Counts) -> float | None:
    true, _, missed, _ = counts
    return true / (true + missed) if true + missed else None


def _f1(counts: Counts) -> float | None:
    true, false, missed, _ = counts
    return 2 * true / (2 * true + false + missed) if true + false + missed else None


def _interval(
    metric: Callable[[Counts], float | None], counts: Counts, samples: Sequence[Counts]
) -> BootstrapInterval:
    values = sorted(value for sample in samples if (value := metric(sample)) is not None)
    if not values:
        return BootstrapInterval(metric(counts), None, None)
    last = len(values) - 1
    return BootstrapInterval(
        metric(counts), values[round(0.025 * last)], values[round(0.975 * last)]
    )
