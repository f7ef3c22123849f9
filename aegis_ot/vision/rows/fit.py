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

from ..types import End, Ends

Floats = NDArray[np.float64]

PITCH_MM = 9.0
_LENGTHS = 0.8, 1.2
"""A tip's ends lie this many of the expected lengths apart, one below the other."""

_LEAN = 0.12
"""Most that an orifice lies beside its collar, tip lengths."""

_SAME_LEAN = 0.03
"""Tips of one row lean alike, within this many tip lengths."""

LEAST_HEAT = 0.16
"""What looks less like a tip is a bare nozzle. On simulated frames (seeds 2100 to 2105 of the
benchmark ``channels``) missing tips reached 0.12, and tips fell to 0.19."""

STRAY = 0.3
"""How far from its place in the row a tip may be, steps."""

SEEN = 0.3
"""Heat of the upper one of two lower ends, as a share of the warmer one's, from which it is seen.

The network has learned from tips of many makes: below the end that it sees it may put another,
warmer one, where that of a longer make would be.
"""

_SAME_STEP = 0.01
"""By how much the steps of the two ends differ before the taper, tip lengths: a camera that looks
up or down sees the lower ends at another scale."""

_LEANS = 0.2
"""How much farther than upright, or than square to their row, tips surely lean, steps."""

_HOLES = 3
"""Most tips beside each other that may be missing within a row."""

_LEAST_STEP = 0.03
"""Tips closer together than this, tip lengths, stand one behind another."""


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
        step = np.asarray(by, float) * (1 + (self.span - 1) / 2 * self.taper)
        places = {i: place + step / (1 + i * self.taper) for i, place in self.places.items()}
        return replace(self, start=self.start + step, places=places)

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
        near = _SAME_LEAN * self.length(number)
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
        middle = (self.span - 1) / 2
        collar_x, _, orifice_x, _ = self.ends(middle)
        step = self.ends(middle + 0.5) - self.ends(middle - 0.5)
        slope = float(np.clip(step[3] / (step[2] or np.inf), -1.0, 1.0))
        return float(orifice_x - collar_x) / self.length(middle), -slope

    @property
    def step_lengths(self) -> float:
        """Distance from tip to tip in the middle of the row, tip lengths."""
        middle = (self.span - 1) / 2
        apart = abs(self.ends(middle + 0.5)[0] - self.ends(middle - 0.5)[0])
        return float(apart / self.length(middle))


def upright(row: Row) -> Row | None:
    """The row with its collars above its orifices; ``None`` if that is where they are.

    Tips hang upright, or square to their row where the camera is turned. Between two tips the
    network puts collars that are none, so what leans by half a step may do so for that.
    """
    lean, square = row.lean
    half = _LEANS * row.step_lengths
    if min(0.0, square) - half <= lean <= max(0.0, square) + half:
        return None
    aside = (lean - square / 2) * row.length((row.span - 1) / 2)
    return row.moved((aside, 0.0, 0.0, 0.0))


def find_row(ends: Ends, length: float, tip_mm: float, count: int) -> Row | None:
    """The row of up to ``count`` tips that explains most of what was seen; ``None`` without two.

    Args:
        ends: What looks like an end of a tip, px.
        length: Of a tip, px, about.
        tip_mm: Of a tip, mm.
        count: Tips that there should be.
    """
    tips = _pairs(ends, length)
    widest = 1.25 * PITCH_MM / tip_mm * length
    chain = _best_chain(tips, length, widest, count)
    return None if chain is None else fitted(tips, chain)


def find_in_wells(ends: Ends, known: Row, tip_mm: float) -> Row | None:
    """A row whose tips hang in wells, by its collars alone: labware hides the lower ends.

    Args:
        ends: What looks like an end of a tip, px.
        known: The same row where it hangs free; as long and as tapered it is here.
        tip_mm: Of a tip, mm.
    """
    count, middle = known.span, (known.span - 1) / 2
    length = known.length(middle)
    down = known.ends(middle)[2:] - known.ends(middle)[:2]
    rows = [(c.x, c.y, c.x + down[0], c.y + down[1], c.heat) for c in ends.collars]
    tips = np.array(sorted(rows)).reshape(-1, 5)
    chain = _best_chain(tips, length, 1.5 * PITCH_MM / tip_mm * length, count)
    if chain is None or len(chain) < count:
        return None
    row = fitted(tips, chain, known.taper)
    # Each as long as where it hung free; in the middle of the row it is so already.
    longer = np.array([(known.ends(i)[2:] - known.ends(i)[:2]) - down for i in range(count)])
    places = {i: place + np.append([0.0, 0.0], longer[i]) for i, place in row.places.items()}
    return replace(row, places=places)


def _best_chain(tips: Floats, length: float, widest: float, count: int) -> dict[int, int] | None:
    """The tips in line that look most like tips together; ``None`` without two."""
    best: tuple[float, dict[int, int]] | None = None
    for first in range(len(tips)):
        for second in range(first + 1, len(tips)):
            step = tips[second, 0] - tips[first, 0]
            if not _LEAST_STEP * length <= step <= widest:
                continue
            chain = _chain(tips, first, second, length, count)
            holes = max(chain) - min(chain) + 1 - len(chain)
            score = sum(tips[at, 4] for at in chain.values()) - 0.2 * holes
            if best is None or score > best[0]:
                best = score, chain
    return None if best is None else best[1]


def _pairs(ends: Ends, length: float) -> Floats:
    """Collars with the orifice below each: ``(n, 5)``, both places and the heat, from the left."""
    pairs = [
        (collar, orifice)
        for collar in ends.collars
        for orifice in ends.orifices
        if _LENGTHS[0] * length <= orifice.y - collar.y <= _LENGTHS[1] * length
        and abs(orifice.x - collar.x) <= _LEAN * length
        and _heat(collar, orifice) >= LEAST_HEAT
    ]
    if not pairs:
        return np.zeros((0, 5))
    leans = np.array([orifice.x - collar.x for collar, orifice in pairs])
    heats = np.array([_heat(collar, orifice) for collar, orifice in pairs])
    near = np.abs(leans[:, None] - leans[None]) <= _SAME_LEAN * length
    # One that leans a whole step fits all tips but one: upright wins where both fit alike.
    scores = (near * heats).sum(axis=1) * (1 - np.abs(leans) / length)
    lean = leans[int(scores.argmax())]
    below: dict[End, list[End]] = {}
    for collar, orifice in pairs:
        if abs(orifice.x - collar.x - lean) <= 2 * _SAME_LEAN * length:
            below.setdefault(collar, []).append(orifice)
    seen = {collar: uppermost(orifices) for collar, orifices in below.items()}
    rows = [(c.x, c.y, o.x, o.y, _heat(c, o)) for c, o in seen.items()]
    return np.array(sorted(rows))


def uppermost(orifices: Sequence[End]) -> End:
    """Of lower ends below one another the one that is seen: see :data:`SEEN`."""
    warmest = max(orifice.heat for orifice in orifices)
    seen = (orifice for orifice in orifices if orifice.heat >= SEEN * warmest)
    return min(seen, key=lambda orifice: orifice.y)


def _heat(collar: End, orifice: End) -> float:
    return float(np.sqrt(max(collar.heat, 0.0) * max(orifice.heat, 0.0)))


def _chain(tips: Floats, first: int, second: int, length: float, count: int) -> dict[int, int]:
    """Tips in line with two neighbours: from their number in the row to that in ``tips``."""
    chain = {0: first, 1: second}
    for way in (1, -1):
        last, before = (1, 0) if way > 0 else (0, 1)
        step = tips[chain[last], :2] - tips[chain[before], :2]
        while True:
            found = next(
                (
                    (gap, at)
                    for gap in range(1, _HOLES + 2)
                    if (at := _at(tips, tips[chain[last], :2] + gap * step, abs(step[0]), length))
                    is not None
                ),
                None,
            )
            if found is None:
                break
            gap, at = found
            number = last + way * gap
            if abs(number - min(chain)) >= count or abs(max(chain) - number) >= count:
                break
            step = (tips[at, :2] - tips[chain[last], :2]) / gap
            chain[number] = at
            last = number
    return chain


def _at(tips: Floats, place: Floats, step: float, length: float) -> int | None:
    """The tip whose collar is at a place."""
    aside = np.abs(tips[:, 0] - place[0]) / (STRAY * step)
    above = np.abs(tips[:, 1] - place[1]) / (_SAME_LEAN * length)
    off = np.maximum(aside, above)
    at = int(off.argmin())
    return at if off[at] <= 1 else None


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
