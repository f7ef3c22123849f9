"""What a few planted deliveries tell: rates with exact intervals, the smallest leftover."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass

import numpy as np
from scipy.special import ndtr, ndtri
from scipy.stats import beta

CAUGHT = 0.9
"""Nine times in ten."""

LEVEL = 0.95

MOST_FALSE_ALARMS = 0.1
"""From what rate of flagged normal wells, for certain, no smallest leftover is told: where
nothing is left too, one in ten is "caught"."""

_MIDDLES = np.log(np.geomspace(0.02, 3.0, 60))
_WIDTHS = np.geomspace(0.08, 1.2, 8)
_LAPSES = np.array([0.0, 0.02, 0.05, 0.1, 0.2, 0.4])


@dataclass(frozen=True)
class Rate:
    """So many of so many, with the exact 95 % interval (Clopper and Pearson, 1934)."""

    hits: int
    of: int

    @property
    def interval(self) -> tuple[float, float]:
        """Whatever the true rate, this covers it in at least 95 of 100 such counts."""
        rest, tail = self.of - self.hits, (1 - LEVEL) / 2
        low = beta.ppf(tail, self.hits, rest + 1) if self.hits else 0.0
        high = beta.ppf(1 - tail, self.hits + 1, rest) if rest else 1.0
        return float(low), float(high)

    def to_json(self) -> dict[str, float | int]:
        low, high = self.interval
        return {"hits": self.hits, "of": self.of, "low": round(low, 4), "high": round(high, 4)}


def rate_of(hits: Iterable[bool]) -> Rate:
    """Of what happened and what did not."""
    told = list(hits)
    return Rate(sum(told), len(told))


@dataclass(frozen=True)
class SmallestLeftover:
    """The smallest share of the volume, left in the tip, that is caught nine times in ten.

    Attributes:
        share: The estimate; ``None``: not even the whole volume.
        low, high: Between which it lies with 95 % probability; ``high`` is ``None`` where more
            than the whole volume would have to be left.
        planted: The least that was planted. Where a figure is this, it is "this or less".
    """

    share: float | None
    low: float
    high: float | None
    planted: float

    def to_json(self) -> dict[str, float | None]:
        return {
            name: None if value is None else round(value, 4) for name, value in asdict(self).items()
        }


def smallest_leftover(
    shares: Sequence[float], caught: Sequence[bool], false_alarms: Rate
) -> SmallestLeftover | None:
    """From leftovers of several sizes; ``None`` without any, or where normal wells are flagged
    more often than :data:`MOST_FALSE_ALARMS` for certain.

    The more is left, the likelier it is caught: a curve that rises with the logarithm of the share
    (normal distribution), from the rate of false alarms to one less what is missed at any size.
    All curves of a grid are weighed by how well they explain what was seen; beforehand all are as
    likely, but that few faults of any size are missed (Beta(1, 10), as psychophysics has it).
    """
    if not len(shares) or false_alarms.interval[0] > MOST_FALSE_ALARMS:
        return None
    base = (false_alarms.hits + 0.5) / (false_alarms.of + 1.0)
    middle, width, lapse = (
        axis.ravel() for axis in np.meshgrid(_MIDDLES, _WIDTHS, _LAPSES, indexing="ij")
    )

    rising = ndtr((np.log(np.asarray(shares, float))[:, None] - middle) / width)
    seen = np.clip(base + (1 - base) * (1 - lapse) * rising, 1e-6, 1 - 1e-6)
    hit = np.asarray(caught, bool)[:, None]
    weight = np.where(hit, np.log(seen), np.log1p(-seen)).sum(axis=0)
    weight += 9 * np.log1p(-lapse)
    weight = np.exp(weight - weight.max())
    wanted = np.clip((CAUGHT - base) / ((1 - base) * (1 - lapse)), 0.0, 1.0)
    least = np.exp(middle + width * ndtri(wanted))  # infinite where one in ten is always missed
    planted = float(min(shares))
    # What is less than was ever planted nobody has seen.
    least = np.where(least <= 1, np.maximum(least, planted), math.inf)
    order = np.argsort(least)
    upto = np.cumsum(weight[order]) / weight.sum()

    def quantile(share: float) -> float:
        return float(least[order][min(int(np.searchsorted(upto, share)), len(order) - 1)])

    tail = (1 - LEVEL) / 2
    low, median, high = quantile(tail), quantile(0.5), quantile(1 - tail)
    return SmallestLeftover(
        None if math.isinf(median) else median,
        min(low, 1.0),
        None if math.isinf(high) else high,
        planted,
    )
