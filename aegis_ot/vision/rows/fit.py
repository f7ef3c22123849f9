"""A row of equal tips in one frame: evenly spaced on the pipette, and so nearly in the picture.

Nozzles stand 9 mm apart on a straight line. A pinhole camera shows equal steps on a line as
``(p + i·q) / (1 + c·i)``, with one taper ``c`` for both ends of all tips: the tips of one row
hang at the same height, and those farther away look smaller and closer together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

PITCH_MM = 9.0

SAME_LEAN = 0.03
"""Tips of one row lean alike, within this many tip lengths."""

STRAY = 0.3
"""How far from its place in the row a tip may be, steps."""

_SAME_STEP = 0.01
"""By how much the steps of the two ends differ before the taper, tip lengths: a camera that looks
up or down sees the lower ends at another scale."""

_LEANS = 0.2
"""How much farther than upright, or than square to their row, tips surely lean, steps."""


@dataclass(frozen=True)
class Row:
    """Tips of one frame, numbered from 0 for the leftmost one that was found.

    Attributes:
        start: Collar x, y and orifice x, y of number 0, px.
        step: The same from one tip to the next, px, before the taper.
        taper: ``c``: positive where tips farther to the right are farther away.
        heats: How much each looks like a tip, by number; some numbers may be missing.
        places: Where each was found, as ``start``.
    """

    start: Floats
    step: Floats
    taper: float
    heats: dict[int, float]
    places: dict[int, Floats]

    def moved(self, by: Sequence[float]) -> Row:
        """The row with its ends elsewhere: by so much in its middle, at every depth alike, px.

        What is nearer is larger: a place ``p / (1 + c·i)`` moves by as much more.
        """
        step = np.asarray(by, float) * (1 + self.middle * self.taper)
        places = {i: place + step / (1 + i * self.taper) for i, place in self.places.items()}
        return replace(self, start=self.start + step, places=places)

    @property
    def middle(self) -> float:
        """Number of the row's middle."""
        return (self.span - 1) / 2

    @property
    def middle_length(self) -> float:
        """Of the tips in the row's middle, px."""
        return self.length(self.middle)

    @property
    def middle_step(self) -> Floats:
        """From tip to tip in the row's middle, both ends, px."""
        return self.ends(self.middle + 0.5) - self.ends(self.middle - 0.5)

    @property
    def span(self) -> int:
        """From the first tip that was found to the last, both counted."""
        return max(self.heats) + 1

    def ends(self, number: float) -> Floats:
        """Collar x, y and orifice x, y of a tip, px; numbers outside the row are extrapolated."""
        place: Floats = (self.start + number * self.step) / (1 + number * self.taper)
        return place

    def best(self, number: int) -> Floats:
        """A tip's ends where they were found, or in line where that strays; as :meth:`ends`."""
        fitted, own = self.ends(number), self.places.get(number)
        near = SAME_LEAN * self.length(number)
        return fitted if own is None or np.abs(own - fitted).max() > near else own

    def length(self, number: float) -> float:
        """Of a tip, px."""
        ends = self.ends(number)
        return float(np.hypot(*(ends[2:] - ends[:2])))

    def apart(self, number: int) -> float:
        """How far beside a tip the nearer of its neighbours' places is, px."""
        here = self.ends(number)[0]
        return float(min(abs(self.ends(number + way)[0] - here) for way in (-1, 1)))

    @property
    def lean(self) -> tuple[float, float]:
        """Orifice beside collar in the middle of the row, and where it would be if the tips hung
        square to their row, tip lengths."""
        collar_x, _, orifice_x, _ = self.ends(self.middle)
        *_, right, down = self.middle_step
        slope = float(np.clip(down / (right or np.inf), -1.0, 1.0))
        return float(orifice_x - collar_x) / self.middle_length, -slope

    @property
    def step_lengths(self) -> float:
        """Distance from tip to tip in the middle of the row, tip lengths."""
        return float(abs(self.middle_step[0]) / self.middle_length)


def upright(row: Row) -> Row | None:
    """The row with its collars above its orifices; ``None`` if that is where they are.

    Tips hang upright, or square to their row where the camera is turned. Between two tips the
    network puts collars that are none, so what leans by half a step may do so for that.
    """
    lean, square = row.lean
    half = _LEANS * row.step_lengths
    if min(0.0, square) - half <= lean <= max(0.0, square) + half:
        return None
    aside = (lean - square / 2) * row.middle_length
    return row.moved((aside, 0.0, 0.0, 0.0))


def fitted(
    tips: Floats, chain: dict[int, int], taper: float | None = None, *, flat: float = 0.0
) -> Row:
    """Least squares over both ends of all tips, those that stray counting less.

    ``taper``: where it is known better than from these tips. ``flat``: how much a row without taper
    is preferred, px of misplaced ends per unit of taper.
    """
    base = min(chain)
    numbers = np.array(sorted(chain)) - base
    seen = tips[[chain[int(number) + base] for number in numbers]]
    places, heats = seen[:, :4], seen[:, 4]
    weight = np.ones_like(places)
    for _ in range(4):
        start, step, slope = _solve(numbers, places, weight, taper, flat)
        off = (start + numbers[:, None] * step) / (1 + numbers[:, None] * slope) - places
        scale = np.maximum(0.7, 1.5 * np.median(np.abs(off), axis=0))
        weight = 1 / np.maximum(1.0, np.abs(off) / scale)
    found = {int(number): float(heat) for number, heat in zip(numbers, heats, strict=True)}
    own = {int(number): place for number, place in zip(numbers, places, strict=True)}
    return Row(start, step, slope, found, own)


def _solve(
    numbers: NDArray[Any], places: Floats, weight: Floats, given: float | None, flat: float
) -> tuple[Floats, Floats, float]:
    """``places·(1 + c·i) = p + q·i`` is linear in p, q (four each) and c."""
    taper = 0.0 if given is None and len(numbers) < 4 else given  # too few to tell it
    rows, values = [], []
    for column in range(4):
        for number, place, w in zip(numbers, places[:, column], weight[:, column], strict=True):
            row = np.zeros(9)
            row[column], row[4 + column] = w, w * number
            if taper is None:
                row[8] = -w * number * place
            rows.append(row)
            values.append(w * place * (1.0 + number * (taper or 0.0)))
    length = float(np.median(np.hypot(*(places[:, 2:] - places[:, :2]).T)))
    tie = 1 / max(_SAME_STEP * length, 0.3)
    for column in (4, 5):
        row = np.zeros(9)
        row[column], row[column + 2] = -tie, tie
        rows.append(row)
        values.append(0.0)
    rows.append(np.append(np.zeros(8), flat))
    values.append(0.0)
    solved = np.linalg.lstsq(np.array(rows), np.array(values), rcond=None)[0]
    return solved[:4], solved[4:8], float(solved[8]) if taper is None else taper
