"""Which outline the tips of one run have, of those that their kind may have."""

from __future__ import annotations

import numpy as np

from .column import TipLook, TipShape, shapes_of
from .tips import TipGeometry

_ENOUGH = 6
"""Free frames from which it is known: three trajectories."""


class Outlines:
    """Sums up how well each outline fits a run's tips where they hang free.

    Two frames laid straight by different outlines cannot be compared row by row.
    """

    def __init__(self) -> None:
        self._told: list[tuple[float, ...]] = []

    def note(self, seen: TipLook) -> None:
        """A tip that hangs free, looked at without an outline being given."""
        if seen.clarities and len(self._told) < _ENOUGH:
            self._told.append(seen.clarities)

    def best(self, tip: TipGeometry) -> TipShape | None:
        """The outline that fits best so far; ``None`` before any frame told."""
        if not self._told:
            return None
        return shapes_of(tip)[int(np.argmax(np.sum(self._told, axis=0)))]

    def known(self, tip: TipGeometry) -> TipShape | None:
        """The same, once enough frames have told."""
        return self.best(tip) if len(self._told) >= _ENOUGH else None
