"""A row by both ends of its tips: a lower end below each upper one, all in line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..types import End, Ends
from .fit import PITCH_MM, SAME_LEAN, STRAY, Floats, Row, fitted

_LENGTHS = 0.8, 1.2
"""A tip's ends lie this many of the expected lengths apart, one below the other."""

_LEAN = 0.12
"""Most that an orifice lies beside its collar, tip lengths."""

LEAST_HEAT = 0.16
"""What looks less like a tip is a bare nozzle. On simulated frames (seeds 2100 to 2105 of the
benchmark ``channels``) missing tips reached 0.12, and tips fell to 0.19."""

SEEN = 0.3
"""Heat of the upper one of two lower ends, as a share of the warmer one's, from which it is seen.

The network has learned from tips of many makes: below the end that it sees it may put another,
warmer one, where that of a longer make would be.
"""

_HOLES = 3
"""Most tips beside each other that may be missing within a row."""

_LEAST_STEP = 0.03
"""Tips closer together than this, tip lengths, stand one behind another."""


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
    count, length = known.span, known.middle_length
    down = known.ends(known.middle)[2:] - known.ends(known.middle)[:2]
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
    near = np.abs(leans[:, None] - leans[None]) <= SAME_LEAN * length
    # One that leans a whole step fits all tips but one: upright wins where both fit alike.
    scores = (near * heats).sum(axis=1) * (1 - np.abs(leans) / length)
    lean = leans[int(scores.argmax())]
    below: dict[End, list[End]] = {}
    for collar, orifice in pairs:
        if abs(orifice.x - collar.x - lean) <= 2 * SAME_LEAN * length:
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
    above = np.abs(tips[:, 1] - place[1]) / (SAME_LEAN * length)
    off = np.maximum(aside, above)
    at = int(off.argmin())
    return at if off[at] <= 1 else None
