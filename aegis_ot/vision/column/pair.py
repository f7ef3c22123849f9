"""The tip before and after its dispense: what one trajectory shows before any other is known.

A dye that leaves the tip changes every row that it filled, from its top down to the orifice.
Where only the upper rows change, the lower ones are still full. That needs no template, no
geometry of the meniscus and no name of the reagent; it needs a liquid that shows.
"""

from __future__ import annotations

import cv2
import numpy as np

from ..tips import TipGeometry
from .contrast import change_between
from .profile import TipProfile

_PLAIN = 8.0
"""Squared change of a row, in variances of a usual one, from which the dye is plain to see."""

_UNCHANGED = 0.15
"""Share of the change that the tip's width lets expect, below which a row has not changed."""

_EXPECTED_LEAST = 3.0
"""Rows of which less change is to be expected tell nothing: the bore is too narrow there."""

_ROWS_LEAST = 12
_LENGTH_LEAST = 120.0
"""Shortest tip, px, in which two frames can be compared row by row without a template."""


def column_left(
    before: TipProfile, after: TipProfile, tip: TipGeometry, top: float, ceiling: float
) -> float | None:
    """Where a column left after the dispense ends (u), or ``None`` if nothing says there is one.

    Args:
        before: The tip loaded, hanging free.
        after: The same tip emptied, hanging free.
        tip: Its geometry.
        top: Where the loaded column should end, u.
        ceiling: Where the free bore begins, u.
    """
    u = before.u
    if len(after.u) != len(u) or min(before.length, after.length) < _LENGTH_LEAST:
        return None
    change = change_between(before, after)
    seen = cv2.blur((change**2).mean(axis=1).astype(np.float32)[:, None], (1, 7))[:, 0]
    inside = (u > max(top, ceiling)) & (u < 0.94)
    if int(inside.sum()) < 2 * _ROWS_LEAST:
        return None
    radius = np.asarray(tip.inner_radius((1.0 - u.astype(np.float64)) * tip.length_mm))
    # A dye takes out light in proportion to its path, and a change counts by its square.
    width = (radius / float(radius[inside].max())) ** 2
    strongest = float((seen[inside] / width[inside])[: int(inside.sum()) // 2].max(initial=0.0))
    due = strongest * width
    if strongest < _PLAIN:
        return None
    tells = inside & (due >= _EXPECTED_LEAST)
    rows = np.flatnonzero(tells)
    if len(rows) < 2 * _ROWS_LEAST:
        return None
    still = seen[rows] < _UNCHANGED * due[rows]
    # Unchanged from here down to the last row that tells.
    tail = int(np.argmin(still[::-1])) if not still.all() else len(rows)
    if tail < max(_ROWS_LEAST, len(rows) // 5) or tail > len(rows) - 4:
        return None
    return float(u[rows[len(rows) - tail]])
