"""Where a column stood that left the tip: how much was drawn, by the trajectory's own two frames.

Between TRANSIT and POST_DISPENSE every row changes in which the liquid stood, and none above it. So
the column's end shows without any template of an empty or a full tip, and without its expected
place having to be right. Before the inside of the tip is known, nothing else tells: see
:class:`~.tip_scale.TipScale`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .column import ceiling
from .column.contrast import change_between
from .column_look import Look
from .usual import alike

ROWS_LEAST = 12
PLAIN = 3.0
"""Change of the rows from which the liquid is plain to see, in a row's usual noise. Two frames of
the same tip differ by up to 2.0 where nothing left it, and by 4.8 at least where a dye did, on
simulated frames of many cameras."""

LONGEST_END = 0.94
"""Rows nearer to the orifice show its rim's glints, u."""

ROW_LEAST_PX = 3.0
"""In a narrower bore, a frame laid a pixel beside the other one changes as much as a dye does."""

_BESIDE, _ABOVE, _BELOW = 8, 0.3, 0.7
"""Rows on either side of the end, and how much of the liquid's change they show: at most above it,
at least below it."""


def across(change: NDArray[np.float32]) -> NDArray[np.float64]:
    """Change of brightness across the whole bore, and of both colours, ``(rows, 3)``.

    A tip that is laid a pixel beside its place changes one side of the bore against the other.
    """
    return np.column_stack([change[:, :-2].mean(axis=1), change[:, -2:]]).astype(np.float64)


def drawn_top(before: Look, after: Look, place: float, reach: float) -> float | None:
    """Upper end of the column that stands in ``before`` and is gone in ``after``, u.

    Args:
        before, after: TRANSIT and POST_DISPENSE.
        place: Where it should end, u.
        reach: How far from there it may.

    Returns:
        ``None`` where the liquid does not show, or its end is not sharp.
    """
    u = before.profile.u.astype(np.float64)
    if len(u) != len(after.profile.u) or not alike(before.light, after.light):
        return None
    width = before.bores
    core = (width >= ROW_LEAST_PX) & (u < LONGEST_END) & (u > place + reach)
    if int(core.sum()) < ROWS_LEAST:
        return None
    change = across(change_between(before.profile, after.profile))
    mean = change[core].mean(axis=0)
    strength = float(np.linalg.norm(mean))
    if strength < PLAIN:
        return None
    share = change @ (mean / strength**2) * float(width[core].mean()) / width
    rows = np.flatnonzero((u > max(ceiling(before.tip), place - reach)) & (u < place + reach))
    wet = share[rows]
    first = int(np.argmax(np.cumsum((wet - 0.5)[::-1])[::-1])) if len(rows) else 0
    above, below = wet[max(first - _BESIDE, 0) : first], wet[first : first + _BESIDE]
    if len(above) < 2 or len(below) < 2 or above.mean() > _ABOVE or below.mean() < _BELOW:
        return None
    upper, lower = float(wet[first - 1]), float(wet[first])
    part = float(np.clip((0.5 - upper) / (lower - upper), 0.0, 1.0)) if lower > upper else 0.5
    return float(u[rows[first - 1]] + part * (u[rows[first]] - u[rows[first - 1]]))
