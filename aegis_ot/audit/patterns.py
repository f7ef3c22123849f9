"""What no single well shows, for all of them show it, or ever more so: drift, and no liquid."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import kendalltau, rankdata

from ..vision.delivery import Shown
from .measures import Measures
from .wells import RunWell

DRIFTING: Mapping[str, Mapping[str, float]] = {
    "after": {"left_40": 0.15, "left_75": 0.15, "retained": 1.0},
    "loaded": {"short": 0.15, "low": 0.02, "faint": 0.15},
}
"""Signs that drift together, and how much one of them must change from the first third of the wells
to the last one, in its own unit, to be worth a person's time."""

_DRIFT_SURE = 6.5
"""Surprise of the trend, nats: one run in seven hundred without one shows it by chance."""

_LEAST_WELLS = 8

_SHOWS, _SEEN = 4.0, 0.1
"""A liquid that shows less plainly than the first, and whose surface is seen in transit in at most
this share of its wells, was in none of them. On simulated development runs clear water reached 3 to
14 and 0.4 to 0.8, dyes 8 at least, empty tips 0 to 2 and 0."""


@dataclass(frozen=True)
class Drift:
    """A trend along the wells of one liquid.

    Attributes:
        family: ``"after"``: more and more stays in the tip. ``"loaded"``: less and less is drawn.
        score: Surprise of it, nats.
        places: Wells beyond what the first ones show, in order.
        changes: By sign, from the first third of the wells to the last.
    """

    family: str
    score: float
    places: tuple[int, ...]
    changes: Mapping[str, float]


def drifts(measured: Sequence[Measures]) -> list[Drift]:
    """Trends along the wells of one liquid, in the order in which they were pipetted."""
    found = (_drift(family, least, measured) for family, least in DRIFTING.items())
    return [one for one in found if one is not None]


def no_liquid(wells: Sequence[RunWell], measured: Sequence[Measures]) -> bool:
    """Whether no well of a liquid shows any: no more change between empty and filled tips than
    chance makes, no surface where the drawn column should end, and nothing seen to leave."""
    if len(wells) < _LEAST_WELLS // 2:
        return False
    if any(well.delivery.shown in (Shown.EMPTIED, Shown.LEFT, Shown.GAP) for well in wells):
        return False
    power = float(np.median([one.power for one in measured]))
    seen = sum(one.meniscus for one in measured) / len(measured)
    return power < _SHOWS and seen <= _SEEN


def _drift(family: str, least: Mapping[str, float], measured: Sequence[Measures]) -> Drift | None:
    if len(measured) < _LEAST_WELLS:
        return None
    ranks = np.zeros(len(measured))
    known = np.zeros(len(measured))
    changes = {}
    third = len(measured) // 3
    for sign in least:
        told = [one.since.get(sign, one.signs.get(sign)) for one in measured]
        places = [place for place, value in enumerate(told) if value is not None]
        if len(places) < max(_LEAST_WELLS, len(measured) // 2):
            continue
        values = np.array([told[place] for place in places], dtype=np.float64)
        ranks[places] += (rankdata(values) - 0.5) / len(values)
        known[places] += 1
        changes[sign] = float(np.median(values[-third:]) - np.median(values[:third]))
    order = np.flatnonzero(known)
    if not any(change >= least[sign] for sign, change in changes.items()):
        return None
    mean = ranks[order] / known[order]
    trend = kendalltau(order, mean, alternative="greater")
    score = -math.log(max(float(trend.pvalue), 1e-12))
    if score < _DRIFT_SURE:
        return None
    first = mean[:third]
    beyond = mean > float(np.median(first)) + 2 * float(np.median(np.abs(first - np.median(first))))
    start = int(np.argmax(beyond & (np.arange(len(mean)) >= third // 2)))
    return Drift(family, score, tuple(int(at) for at in order[start:]), changes)
