"""What a few planted deliveries tell of further runs: rates with intervals, the smallest leftover.

Wells of one run share its calibration. So an interval is that of Clopper and Pearson (1934) at an
effective number of wells (Korn and Graubard 1998): their number over the design effect of Kish
(1965), ``1 + (wells - 1) * spread``. The spread, an intraclass correlation, is estimated from two
halves that are calibrated apart, by moments (Williams 1982).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass

import numpy as np
from scipy.special import betaincinv, ndtr, ndtri

CAUGHT = 0.9
"""Nine times in ten."""

LEVEL = 0.95

MOST_FALSE_ALARMS = 0.1
"""From what rate of flagged normal wells, for certain, no smallest leftover is told: where
nothing is left too, one in ten is "caught"."""

_MIDDLES = np.log(np.geomspace(0.02, 3.0, 60))
_WIDTHS = np.geomspace(0.08, 1.2, 8)
_LAPSES = np.array([0.0, 0.02, 0.05, 0.1, 0.2, 0.4])


def spread_between(halves: Sequence[tuple[tuple[int, int], tuple[int, int]]]) -> float:
    """Intraclass correlation of the halves of groups, each as caught of all, 0 to 1 (Williams):
    Pearson's chi squared of a group has a mean of ``1 + (wells of a half - 1) * spread``."""
    hits, sizes = np.moveaxis(np.array(halves, float).reshape(-1, 2, 2), 2, 0)
    rate = hits.sum(axis=1) / sizes.sum(axis=1)
    # What was caught throughout, or never, tells nothing; nor do halves of a single well.
    told = (rate > 0) & (rate < 1) & (sizes.mean(axis=1) > 1)
    hits, sizes, rate = hits[told], sizes[told], rate[told, None]
    squares = float(((hits - sizes * rate) ** 2 / (sizes * rate * (1 - rate))).sum())
    excess = squares - told.sum()
    return float(min(excess / (sizes.mean(axis=1) - 1).sum(), 1.0)) if excess > 0 else 0.0


@dataclass(frozen=True)
class Rate:
    """So many of so many, with a 95 % interval for further runs, which differ by ``spread``."""

    hits: int
    of: int
    spread: float = 0.0

    @property
    def design_effect(self) -> float:
        return 1.0 + max(self.of - 1, 0) * self.spread

    @property
    def interval(self) -> tuple[float, float]:
        """Whatever the true rate, this covers it in at least 95 of 100 counts without a spread."""
        tail = (1 - LEVEL) / 2
        hits, rest = (count / self.design_effect for count in (self.hits, self.of - self.hits))
        low = betaincinv(hits, rest + 1, tail) if self.hits else 0.0
        high = betaincinv(hits + 1, rest, 1 - tail) if self.of > self.hits else 1.0
        return float(low), float(high)

    def to_json(self) -> dict[str, float | int]:
        low, high = self.interval
        return {"hits": self.hits, "of": self.of, "low": round(low, 4), "high": round(high, 4)}


def rate_of(hits: Iterable[bool], spread: float = 0.0) -> Rate:
    """Of what happened and what did not."""
    told = list(hits)
    return Rate(sum(told), len(told), spread)


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
    shares: Sequence[float], caught: Sequence[bool], false_alarms: Rate, spread: float = 0.0
) -> SmallestLeftover | None:
    """From leftovers of several sizes; ``None`` without any, or where normal wells are flagged
    more often than :data:`MOST_FALSE_ALARMS` for certain.

    The more is left, the likelier it is caught: a curve that rises with the logarithm of the share
    (normal distribution), from the rate of false alarms to one less what is missed at any size.
    All curves of a grid are weighed by how well they explain what was seen; beforehand all are as
    likely, but that few faults of any size are missed (Beta(1, 10), as psychophysics has it). What
    was seen weighs as much as the effective number of wells, by ``spread``.
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
    weight /= Rate(0, len(shares), spread).design_effect
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
