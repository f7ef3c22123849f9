"""Each nozzle of a row looked at by itself: whether there is a tip on it, and where that ends.

Two witnesses. The network looks at each place in a close-up, as it looks at single tips; in the
strip in which a row is found it sees eight at once. And the tips of one row look alike: whatever
the network makes of a tip before a bright panel, its outline is that of its neighbours, and a bare
nozzle's is not.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from ..column.axis import onto_outline
from ..column.strip import TipShape, resample
from ..types import Axis, Ends, Image, RowDetector
from .both_ends import uppermost
from .fit import STRAY, Floats, Row, fitted

_BESIDE = 0.65
"""A collar that is seen this far beside its place still says that a tip hangs there, steps: between
two tips the network puts collars that are none."""

_COLLAR, _ORIFICE = 0.06, 0.2
"""How far above or below its place an end may be, tip lengths."""

_LONGER = 0.06
"""How much longer or shorter than those of its row a tip may look, tip lengths."""

_TRUSTED = 0.6
"""Median heat of a row whose ends are taken as the network gives them."""

_SURE = 0.3
"""Heat of the tips with which others are compared."""

_COLD, _TIP, _SHARE, _NO_DOUBT = 0.12, 0.7, 0.65, 0.8
"""There is a tip where the heat alone reaches the first, and the evidence the second and the third,
a share of what the row's sure tips have: before an even background a bare nozzle is not unlike a
tip. At the fourth, another share, it is beyond doubt."""

_LEAST = 0.1
"""Heat from which a place speaks for a row."""

_ROWS, _STEEPEST = 100, 3.0
"""Rows of an outline, collar to orifice; and how steep a step may count, times the usual one."""


@dataclass(frozen=True)
class Nozzle:
    """What one nozzle's place shows.

    Attributes:
        ends: Collar x, y and orifice x, y of the tip, px.
        heat: How much the network takes it for a tip, 0 to 1.
        likeness: Correlation of its outline with that of the row's sure tips, -1 to 1.
    """

    ends: Floats
    heat: float
    likeness: float = 0.0

    @property
    def evidence(self) -> float:
        """Heat and likeness together: for a tip."""
        return self.heat + self.likeness


def look_at_nozzles(detector: RowDetector, image: Image, row: Row, count: int) -> dict[int, Nozzle]:
    """A close-up of every place where one of ``count`` nozzles may be, by number in the row."""
    height, width = image.shape[:2]
    numbers = [
        number
        for number in range(row.span - count, count)
        if 0 <= row.ends(number)[2] < width and 0 < row.length(number) < 2 * height
    ]
    if not numbers:
        return {}
    seen = detector.ends_of_each(image, [_axis(row.ends(number)) for number in numbers])
    return {number: _nozzle(ends, row, number) for number, ends in zip(numbers, seen, strict=True)}


def promise(nozzles: Mapping[int, Nozzle], count: int) -> float:
    """How much of the heat of ``count`` tips the places of a row have."""
    warm = {number: one for number, one in nozzles.items() if one.heat >= _LEAST}
    return sum(one.heat for one in _together(warm, count).values())


def compare(
    nozzles: Mapping[int, Nozzle], image: Image, shape: TipShape, *, closely: bool = False
) -> dict[int, Nozzle]:
    """The same with each one's likeness to the sure tips among the others.

    Args:
        nozzles: By number in the row.
        image: Whole frame, ``(height, width, 3)`` uint8, BGR.
        shape: Of the tips.
        closely: Whether each axis is put onto the outline first (3 ms each, and not 0.3 ms).
    """
    outlines = {
        number: _outline(image, one.ends, shape, closely) for number, one in nozzles.items()
    }
    sure = [number for number, one in nozzles.items() if one.heat >= _SURE]

    def likeness(number: int) -> float:
        others = [outlines[other] for other in sure if other != number]
        if sure == [number]:  # it is what the others are compared with
            others = [outline for other, outline in outlines.items() if other != number]
        if not others:
            return 0.0
        mean = np.mean(others, axis=0)
        return float((outlines[number] * mean).sum() / max(np.linalg.norm(mean), 1e-9))

    return {number: replace(one, likeness=likeness(number)) for number, one in nozzles.items()}


def with_tip(nozzles: Mapping[int, Nozzle], *, surely: bool = False) -> dict[int, Nozzle]:
    """Those on which there is a tip; ``surely``: those that leave no doubt."""
    sure = [one.evidence for one in nozzles.values() if one.heat >= _SURE]
    least = max(_TIP, (_NO_DOUBT if surely else _SHARE) * float(np.median(sure or [0.0])))
    return {
        number: one
        for number, one in nozzles.items()
        if one.heat >= _COLD and one.evidence >= least
    }


def row_of(nozzles: Mapping[int, Nozzle], count: int) -> Row | None:
    """The row of those that have a tip; ``None`` without two."""
    tips = _together(with_tip(nozzles), count)
    if len(tips) < 2:
        return None
    table = np.array([(*one.ends, one.heat) for one in tips.values()])
    return fitted(table, {number: at for at, number in enumerate(tips)})


def on_outlines(row: Row, image: Image, shape: TipShape) -> Row:
    """The row fitted to its tips' outlines, where the network is not sure of it: what it says of
    collars is rough then. A sure row is left alone: of a narrow tip it knows more than edges do.
    """
    if np.median([*row.heats.values()]) >= _TRUSTED:
        return row
    table = []
    for number, heat in row.heats.items():
        ends = row.best(number)
        collar, orifice, _ = onto_outline(image, ends[:2], ends[2:], shape)
        table.append((*collar, *orifice, heat))
    chain = {number: at for at, number in enumerate(row.heats)}
    return fitted(np.array(table), chain, row.taper)


def clarity(row: Row, image: Image, shape: TipShape) -> float:
    """How much of what is seen around the tips of a row lies on their outline."""
    ends = [row.ends(number) for number in row.heats]
    return float(np.median([onto_outline(image, one[:2], one[2:], shape)[2] for one in ends]))


def _axis(ends: Floats) -> Axis:
    collar_x, collar_y, orifice_x, orifice_y = map(float, ends)
    return (collar_x, collar_y), (orifice_x, orifice_y)


def _nozzle(ends: Ends, row: Row, number: int) -> Nozzle:
    """What a close-up shows of the tip that is looked for."""
    place, length = row.ends(number), row.length(number)
    step = abs(float(row.ends(number + 1)[2] - place[2]))
    orifices = [
        end
        for end in ends.orifices
        if abs(end.x - place[2]) <= STRAY * step and abs(end.y - place[3]) <= _ORIFICE * length
    ]
    collars = [
        end
        for end in ends.collars
        if abs(end.x - place[0]) <= _BESIDE * step and abs(end.y - place[1]) <= _COLLAR * length
    ]
    if not orifices:
        return Nozzle(place, 0.0)
    heats = (max((end.heat for end in each), default=0.0) for each in (collars, orifices))
    below = uppermost(orifices)
    tip = place[3] - place[1]
    near = [
        end
        for end in collars
        if abs(end.x - place[0]) <= STRAY * step and abs(below.y - end.y - tip) <= _LONGER * length
    ]
    above = max(near, key=lambda end: end.heat, default=None)
    top = (place[0], below.y - tip) if above is None else (above.x, above.y)
    return Nozzle(np.array([*top, below.x, below.y]), float(np.sqrt(np.prod([*heats]))))


def _together(nozzles: Mapping[int, Nozzle], count: int) -> dict[int, Nozzle]:
    """Those among ``count`` places beside each other that say most."""

    def said(first: int) -> float:
        return sum(
            one.evidence for number, one in nozzles.items() if first <= number < first + count
        )

    if not nozzles:
        return {}
    first = max(range(min(nozzles) - count + 1, max(nozzles) + 1), key=said)
    return {number: nozzles[number] for number in sorted(nozzles) if 0 <= number - first < count}


def _outline(image: Image, ends: Floats, shape: TipShape, closely: bool) -> NDArray[np.float32]:
    """The edges along and across a tip laid straight, as one vector of length 1."""
    collar, orifice = ends[:2].astype(np.float64), ends[2:].astype(np.float64)
    if closely:
        collar, orifice, _ = onto_outline(image, collar, orifice, shape)
    pixels, _, _ = resample(image, collar, orifice, _ROWS, shape.half_width)
    grey = cv2.GaussianBlur(pixels.mean(axis=2), (3, 3), 0)
    edges = []
    for axis in (0, 1):
        step = np.abs(np.gradient(grey, axis=axis))
        step = np.minimum(step / (np.median(step) + 1), _STEEPEST)
        edges.append(cv2.GaussianBlur(step, (3, 7), 0))
    outline = np.stack(edges).astype(np.float32)
    outline -= outline.mean()
    return np.asarray(outline / max(float(np.linalg.norm(outline)), 1e-9), dtype=np.float32)
