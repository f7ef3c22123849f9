"""How far each well stands from the others of its liquid, sign by sign."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .measures import ANOTHER_EDGE, HEIGHTS, Measures

LEFT = tuple(f"left_{share * 100:.0f}" for share in HEIGHTS)

FAMILIES: Mapping[str, tuple[str, ...]] = {
    "after": LEFT,
    "both after": ("retained",),
    "loaded": ("short", "gap", "low", "high", "absent"),
    "change": ("faint",),
    "look": ("score",),
}
"""Signs that see the same thing: of each family the strongest counts, and the families add up."""

LEAST: Mapping[str, float] = {
    **dict.fromkeys(LEFT, 0.05),
    "retained": 0.6,
    "short": 0.06,
    "gap": 1.0,
    "low": 0.008,
    "high": 0.008,
    "absent": 2.0,
    "faint": 0.06,
    "score": 1.0,
}
"""Smallest spread of normal wells that is believed, by sign, in its own unit: a few that agree by
chance must not make the next one stand out."""

_ENOUGH = 3
"""Wells from which there is anything usual."""

_FREEDOM = 5.0
"""Degrees of freedom of the t distribution by whose tail a distance counts: the spread of some
twenty wells is itself uncertain, and normal wells have tails."""


@dataclass(frozen=True)
class WellStanding:
    """Where one well stands among the others.

    Attributes:
        distance: From the others' median, robust standard deviations, by sign.
        usual: The others' median, by sign.
    """

    distance: Mapping[str, float]
    usual: Mapping[str, float]

    def strongest(self) -> dict[str, tuple[str, float]]:
        """Of each family its strongest sign and that one's surprise, nats."""
        told: dict[str, tuple[str, float]] = {}
        for family, signs in FAMILIES.items():
            known = {sign: nats(self.distance[sign]) for sign in signs if sign in self.distance}
            if known:
                sign = max(known, key=lambda name: known[name])
                told[family] = (sign, known[sign])
        return told

    @property
    def total(self) -> float:
        """Surprise of all families together, nats."""
        return sum(value for _, value in self.strongest().values())


def standings(measured: Sequence[Measures], trusted: Sequence[bool]) -> list[WellStanding]:
    """Of each well of one liquid among the trusted ones."""
    usual: dict[str, float] = {}
    spread: dict[str, float] = {}
    for sign, least in LEAST.items():
        known = [
            one.signs[sign]
            for one, trust in zip(measured, trusted, strict=True)
            if trust and sign in one.signs
        ]
        if len(known) >= _ENOUGH:
            middle = float(np.median(known))
            if sign in ("low", "high") and abs(middle) >= ANOTHER_EDGE:
                continue  # in most wells another edge is seen, so none is out of place
            usual[sign] = middle
            spread[sign] = max(
                1.48 * float(np.median(np.abs(np.array(known) - usual[sign]))), least
            )
    return [
        WellStanding(
            {s: (v - usual[s]) / spread[s] for s, v in one.signs.items() if s in usual}, usual
        )
        for one in measured
    ]


def nats(distance: float) -> float:
    """Surprise of a distance, by the tail of a t distribution up to a constant."""
    over = max(distance, 0.0)
    return 0.5 * (_FREEDOM + 1.0) * math.log1p(over * over / _FREEDOM)
