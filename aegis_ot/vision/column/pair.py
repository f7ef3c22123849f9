"""The tip before and after its dispense, in two frames at one place."""

from __future__ import annotations

import numpy as np

from ..types import Axis

_ONE_PLACE = 0.03
"""How far apart both ends of a tip may be seen in two frames at one place, tip lengths."""


def at_one_place(tip: Axis, again: Axis) -> bool:
    """Whether two frames show a tip at one place, so that what stands behind it is the same."""
    ends = np.array((tip, again), dtype=np.float64)
    length = float(np.hypot(*(ends[0, 0] - ends[0, 1])))
    return bool((np.hypot(*(ends[0] - ends[1]).T) <= _ONE_PLACE * length).all())
