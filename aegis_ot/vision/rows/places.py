"""Where a run's rows stand in the frame, so that a missing tip at an end is told from a shift."""

from __future__ import annotations

import numpy as np

from ..types import Position
from .fit import Row

_MEMORY = 24
_SAME_MM = 0.5
_UNEXPLORED_MM = 2.0
"""A place this far off the line of those seen so far cannot be predicted."""


class RowPlaces:
    """Whole rows of free frames: the robot's position and where the leftmost collar was."""

    def __init__(self) -> None:
        self._seen: list[tuple[Position, float]] = []
        self.last: Row | None = None
        """The last whole row."""

    def note(self, position: Position | None, row: Row) -> None:
        """A whole row was seen."""
        self.last = row
        if position is not None:
            self._seen.append((position, float(row.ends(0)[0])))
            del self._seen[:-_MEMORY]

    def offset(self, position: Position | None, row: Row, count: int) -> int | None:
        """How many tips are missing to the left of a row that is not whole.

        Returns:
            ``None`` if it cannot be told.
        """
        most = count - row.span
        wanted = self._predict(position)
        if most <= 0:
            return 0
        if wanted is None:
            return None
        steps = [abs(float(row.ends(-offset)[0]) - wanted) for offset in range(most + 1)]
        best = int(np.argmin(steps))
        apart = abs(float(row.ends(1)[0] - row.ends(0)[0]))
        return best if steps[best] < 0.4 * apart else None

    def _predict(self, position: Position | None) -> float | None:
        """Where the leftmost collar should be, px: it moves in proportion to the robot, nearly."""
        if position is None or not self._seen:
            return None
        places = np.array([seen[0][:2] for seen in self._seen])
        x = np.array([seen[1] for seen in self._seen])
        there = np.array(position[:2])
        off = np.hypot(*(places - there).T)
        if off.min() <= _SAME_MM:
            return float(x[int(off.argmin())])
        middle = places.mean(axis=0)
        _, sizes, axes = np.linalg.svd(places - middle, full_matrices=False)
        axes = axes[sizes > _UNEXPLORED_MM]
        along = axes @ (there - middle)
        if np.hypot(*(there - middle - along @ axes)) > _UNEXPLORED_MM:
            return None
        slopes = np.linalg.lstsq((places - middle) @ axes.T, x - x.mean(), rcond=None)[0]
        return float(x.mean() + along @ slopes)
