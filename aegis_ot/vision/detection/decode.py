"""From the network's maps to tip axes.

The network gives seven maps at a quarter of the view's resolution: how likely a cell holds the
collar, and the orifice (0, 1); where in the cell the point lies (2, 3: px from the cell's
centre); the vector from collar to orifice (4, 5: in units of 64 px); the logarithm of half the
tip's width in px (6). The last five mean something only near a collar or an orifice.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

Maps = NDArray[np.float32]

STRIDE = 4
CHANNELS = 7
VECTOR_UNIT = 64.0
COLLAR, ORIFICE = 0, 1
_PEAKS = 4
_SEARCH = 0.2  # of the tip's length: how far an orifice may lie from where the collar puts it


@dataclass(frozen=True)
class Candidate:
    """A tip that the maps may show, in px of the view.

    Attributes:
        collar, orifice: Ends of the axis (x, y).
        radius: Half the tip's greatest width.
        score: Geometric mean of the two ends' heat, 0 to 1.
    """

    collar: tuple[float, float]
    orifice: tuple[float, float]
    radius: float
    score: float


@dataclass(frozen=True)
class _Peak:
    x: float
    y: float
    heat: float
    vector: tuple[float, float]
    radius: float


def _peak(maps: Maps, kind: int, row: int, column: int) -> _Peak:
    """The point at a cell: mean of what the cells around it say, weighted by their heat."""
    _, rows, columns = maps.shape
    r0, r1 = max(0, row - 1), min(rows, row + 2)
    c0, c1 = max(0, column - 1), min(columns, column + 2)
    part = maps[:, r0:r1, c0:c1].astype(np.float64)
    weight = part[kind] ** 2
    weight /= max(float(weight.sum()), 1e-12)
    ys, xs = np.mgrid[r0:r1, c0:c1]
    return _Peak(
        float((weight * ((xs + 0.5) * STRIDE + part[2])).sum()),
        float((weight * ((ys + 0.5) * STRIDE + part[3])).sum()),
        float(maps[kind, row, column]),
        (
            float((weight * part[4]).sum()) * VECTOR_UNIT,
            float((weight * part[5]).sum()) * VECTOR_UNIT,
        ),
        float(np.exp((weight * part[6]).sum())),
    )


def _highest(heat: NDArray[np.float32], count: int) -> Iterator[tuple[int, int]]:
    """Cells of the highest local maxima, highest first."""
    left = heat.copy()
    for _ in range(count):
        row, column = divmod(int(left.argmax()), left.shape[1])
        yield row, column
        left[max(0, row - 2) : row + 3, max(0, column - 2) : column + 3] = 0


def _near(maps: Maps, kind: int, x: float, y: float, reach: float) -> _Peak | None:
    """The warmest point within ``reach`` px of a place."""
    _, rows, columns = maps.shape
    r0, r1 = max(0, int((y - reach) / STRIDE)), min(rows, int((y + reach) / STRIDE) + 1)
    c0, c1 = max(0, int((x - reach) / STRIDE)), min(columns, int((x + reach) / STRIDE) + 1)
    if r1 <= r0 or c1 <= c0:
        return None
    part = maps[kind, r0:r1, c0:c1]
    row, column = divmod(int(part.argmax()), part.shape[1])
    return _peak(maps, kind, r0 + row, c0 + column)


def candidates(maps: Maps, least: float, count: int) -> list[Candidate]:
    """The likeliest tips, likeliest first.

    Each warm collar looks for its orifice where its vector points, and the other way round.

    Args:
        maps: Output of the network for one view, shape ``(7, rows, columns)``.
        least: Score below which nothing is said, 0 to 1.
        count: Most candidates given.
    """
    found: list[Candidate] = []
    for kind, sign in ((COLLAR, 1.0), (ORIFICE, -1.0)):
        for row, column in _highest(maps[kind], _PEAKS):
            if maps[kind, row, column] < least**2:
                break
            here = _peak(maps, kind, row, column)
            reach = max(6.0, _SEARCH * float(np.hypot(*here.vector)))
            x, y = here.x + sign * here.vector[0], here.y + sign * here.vector[1]
            there = _near(maps, 1 - kind, x, y, reach)
            if there is None:
                continue
            collar, orifice = (here, there) if kind == COLLAR else (there, here)
            score = float(np.sqrt(max(0.0, here.heat) * max(0.0, there.heat)))
            # A tip hangs: its orifice is the lower end.
            if score < least or orifice.y - collar.y < 4.0:
                continue
            radius = (here.radius * here.heat + there.radius * there.heat) / (
                here.heat + there.heat
            )
            found.append(Candidate((collar.x, collar.y), (orifice.x, orifice.y), radius, score))
    found.sort(key=lambda c: -c.score)
    kept: list[Candidate] = []
    for candidate in found:
        if all(_apart(candidate, other) for other in kept):
            kept.append(candidate)
    return kept[:count]


def peaks(maps: Maps, kind: int, least: float) -> list[tuple[float, float, float]]:
    """Every local maximum of one end's heat: x, y in px of the view, and the heat.

    Args:
        maps: Output of the network for one view, shape ``(7, rows, columns)``.
        kind: :data:`COLLAR` or :data:`ORIFICE`.
        least: Heat below which nothing counts, 0 to 1.
    """
    heat = np.ascontiguousarray(maps[kind])
    highest = cv2.dilate(heat, np.ones((3, 3), np.uint8))
    places = np.argwhere((heat >= highest) & (heat >= least))
    found = (_peak(maps, kind, int(row), int(column)) for row, column in places)
    return [(peak.x, peak.y, peak.heat) for peak in found]


def _apart(a: Candidate, b: Candidate) -> bool:
    length = b.orifice[1] - b.collar[1]
    gaps = [
        np.hypot(p[0] - q[0], p[1] - q[1])
        for p, q in ((a.collar, b.collar), (a.orifice, b.orifice))
    ]
    return bool(max(gaps) > 0.25 * length)
