"""How surprising a value is among normals, when there are only a few dozen of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

MOST = 15.0
"""Surprise of one sign is cut off here, nats: beyond it the tail is an extrapolation."""

NO_TIP = 40.0
"""Score of a trajectory in which no tip is seen when it hangs free, nats."""


@dataclass(frozen=True)
class Tail:
    """Upper tail of a sign among normals: exponential beyond a start value.

    An empirical p-value cannot fall below 1/(n+1); with an exponential tail the surprise,
    ``-log p`` up to a constant, goes on rising with the evidence, in the same unit (nats) for
    every sign, so that signs add up and plates compare.

    Attributes:
        start: Where the tail begins: a high quantile of the normals.
        scale: Mean excess over it.
    """

    start: float
    scale: float

    def surprise(self, value: float | None) -> float:
        """Nats above the start, 0 to :data:`MOST`; 0 for a sign that could not be told."""
        if value is None or not np.isfinite(value):
            return 0.0
        return float(np.clip((value - self.start) / self.scale, 0.0, MOST))


_START = 0.85
_PRIOR_WEIGHT = 4.0


def fit_tail(values: Sequence[float], prior: Tail) -> Tail:
    """Tail of the normals' values, drawn towards ``prior`` as if by four more values.

    The scale stays within half and one and a half times the prior's: a few normals that happen
    to agree must not make the next one an alarm, and one odd normal must not blind the sign.
    """
    known = np.array([value for value in values if np.isfinite(value)], dtype=float)
    if len(known) == 0:
        return prior
    share = len(known) / (len(known) + _PRIOR_WEIGHT)
    start = share * float(np.quantile(known, _START)) + (1 - share) * prior.start
    over = known[known > start] - start
    scale = (float(over.sum()) + prior.scale) / (len(over) + 1.0)
    return Tail(start, float(np.clip(scale, 0.5 * prior.scale, 1.5 * prior.scale)))
