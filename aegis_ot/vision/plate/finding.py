"""Finds a plate's wells in a picture from above: its outline first, then the grid inside it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter

from ..types import Image
from .formats import FORMATS, LENGTH_MM, WIDTH_MM, PlateFormat
from .outline import Corners, outlines

Points = NDArray[np.float64]
Votes = NDArray[np.float32]

_LONGEST = 1600
"""Longest side of the picture in which the grid is looked for, px: more shows nothing more."""

_SCALE, _MARGIN_MM = 8.0, 8.0
"""Of the picture of a plate laid straight: px per mm, and what is left around the footprint."""

_BAND = np.linspace(0.88, 1.12, 6)
"""Radii at which a well's edge votes for its middle, shares of the usual one."""

_STRETCH = np.linspace(0.93, 1.07, 15)
"""Pitches tried, shares of the usual one: outlines err, and makers differ."""

_MANY = 90
"""Wells from which each is read together with its neighbours."""

_WITHIN = 0.12
"""Farthest that a well may be seen from its place in the grid, pitches."""

_LEAST_SHARE = 0.8
"""Share of the wells that must be seen in their places."""

_LEAST_LIKE, _LEAST_LIKE_SQUARE, _BEYOND = 4.5, 2.0, 0.6
"""How much the grid's places must stand out of the votes, standard deviations: a plate of another
kind rarely does as much; and how much of that the places just outside the grid may show."""

_SURE = 7.0
"""How much no grid of another kind than the plate's own stood out in development pictures."""

LEAST_PITCH_PX = 9.0
"""Wells nearer to each other than this in the picture show no colour of their own."""


@dataclass(frozen=True)
class FoundPlate:
    """A plate's grid in a picture.

    Attributes:
        plate: Its kind.
        to_picture: Homography from the plane of the wells' rims (mm from the plate's middle, y
            down the rows) to the picture, px.
        share: Of the wells that were seen in their places, 0 to 1.
        like: How much the grid stands out of what else is seen, standard deviations: highest for
            the plate's own kind.
        upright: Whether the columns run down the picture instead of across it.
    """

    plate: PlateFormat
    to_picture: Points
    share: float
    like: float
    upright: bool

    def pixels(self, places: Points) -> Points:
        """Places on the plate, ``(n, 2)`` mm, in the picture, px."""
        found = cv2.perspectiveTransform(places.reshape(-1, 1, 2), self.to_picture)
        return np.asarray(found, np.float64).reshape(-1, 2)

    @property
    def pitch_px(self) -> float:
        """From well to well, where that is smallest, px."""
        grid = self.pixels(self.plate.centres()).reshape(self.plate.rows, self.plate.columns, 2)
        steps = [np.linalg.norm(np.diff(grid, axis=axis), axis=2).min() for axis in (0, 1)]
        return float(min(steps))

    def turned(self) -> FoundPlate:
        """The same with A1 at the opposite corner."""
        half = np.diag([-1.0, -1.0, 1.0])
        return replace(self, to_picture=self.to_picture @ half)


def find_plate(image: Image, plate: PlateFormat) -> FoundPlate | None:
    """The wells of a plate in a picture from above; ``None`` if its grid is not found.

    A1 is at the top left where the plate lies lengthwise, at the top right where it stands
    upright: the grid alone does not tell it from the corner opposite.

    Args:
        image: BGR.
        plate: Which kind is looked for.
    """
    scale = min(_LONGEST / max(image.shape[:2]), 1.0)
    small = image
    if scale < 1:
        small = np.asarray(cv2.resize(image, None, fx=scale, fy=scale,
                                      interpolation=cv2.INTER_AREA), np.uint8)  # fmt: skip
    found = [one for corners in outlines(small) if (one := _fit(small, corners, plate))]
    if not found:
        return None
    best = max(found, key=lambda one: (one.share, one.like))
    least = _LEAST_LIKE_SQUARE if plate.square else _LEAST_LIKE
    if best.share < _LEAST_SHARE or best.like < least:
        return None
    # Pixels are counted from their corners: no half to add when the size changes.
    return replace(best, to_picture=np.diag([1 / scale, 1 / scale, 1.0]) @ best.to_picture)


def other_kind(image: Image, found: FoundPlate | None) -> PlateFormat | None:
    """The kind of plate that a picture shows rather than the one that was looked for, if any."""
    if found is not None and (found.plate.square or found.like > _SURE):
        return None
    like = 0.0 if found is None else found.like
    kinds = (one for one in FORMATS.values() if found is None or one is not found.plate)
    seen = [one for one in (find_plate(image, kind) for kind in kinds) if one is not None]
    best = max(seen, key=lambda one: one.like, default=None)
    return best.plate if best is not None and best.like > like else None


def _fit(image: Image, corners: Corners, plate: PlateFormat) -> FoundPlate | None:
    """The grid inside an outline."""
    wide, tall = LENGTH_MM + 2 * _MARGIN_MM, WIDTH_MM + 2 * _MARGIN_MM
    size = (round(wide * _SCALE), round(tall * _SCALE))
    edges = np.array([(_MARGIN_MM, _MARGIN_MM), (wide - _MARGIN_MM, _MARGIN_MM),
                      (wide - _MARGIN_MM, tall - _MARGIN_MM), (_MARGIN_MM, tall - _MARGIN_MM)],
                     np.float32) * np.float32(_SCALE)  # fmt: skip
    straighten = cv2.getPerspectiveTransform(corners, edges)
    straight = cv2.warpPerspective(image, straighten, size, borderMode=cv2.BORDER_REPLICATE)
    votes = _votes(cv2.cvtColor(straight, cv2.COLOR_BGR2GRAY), plate)
    middle = np.array(size) / 2
    places = _coarse(votes, plate, middle)
    grid: Points | None = None
    for reach in (0.35, 0.35, 0.25, 0.18):
        seen, strong = _peaks(votes, plate, places, reach * plate.pitch_mm * _SCALE)
        grid = _grid(plate, seen, strong)
        if grid is None:
            return None
        grid = _set_right(votes, plate, grid)
        places = cv2.perspectiveTransform(plate.centres().reshape(-1, 1, 2), grid).reshape(-1, 2)
    assert grid is not None
    off = np.linalg.norm(seen - places, axis=1) / (plate.pitch_mm * _SCALE)
    share = float(((off < _WITHIN) & strong).mean())
    like = _contrast(votes, plate, grid)
    along = corners[1] - corners[0] + corners[2] - corners[3]
    to_picture = np.linalg.inv(straighten) @ grid
    return FoundPlate(plate, to_picture, share, like, bool(abs(along[1]) > abs(along[0])))


def _votes(grey: NDArray[np.uint8], plate: PlateFormat) -> Votes:
    """For each point how many edges lie around it at a well's radius: high at wells' middles."""
    smooth = cv2.GaussianBlur(grey, (0, 0), 1.5).astype(np.float32)
    gx, gy = cv2.Sobel(smooth, cv2.CV_32F, 1, 0), cv2.Sobel(smooth, cv2.CV_32F, 0, 1)
    strength = np.hypot(gx, gy)
    y, x = np.nonzero(strength > np.percentile(strength, 60))
    strong = strength[y, x]
    # The plate's own outline and glints are far stronger than a pale well's edge.
    weight = np.minimum(strong, np.percentile(strong, 60))
    ux, uy = gx[y, x] / strong, gy[y, x] / strong
    tall, wide = grey.shape
    votes = np.zeros(tall * wide)
    for radius in _BAND * plate.radius_mm * _SCALE:
        # Inwards from an edge that is darker inside: a rim. The floor's edge, seen aside, is not.
        px, py = np.round(x - radius * ux).astype(int), np.round(y - radius * uy).astype(int)
        inside = (px >= 0) & (px < wide) & (py >= 0) & (py < tall)
        at = py[inside] * wide + px[inside]
        votes += np.bincount(at, weight[inside], tall * wide)
    pitch = plate.pitch_mm * _SCALE
    fine = cv2.GaussianBlur(votes.reshape(tall, wide).astype(np.float32), (0, 0), 0.06 * pitch)
    plain = cv2.blur(fine, (round(pitch) | 1,) * 2)
    return np.asarray((fine - plain) / max(float(np.std(fine - plain)), 1e-6), np.float32)


def _at(votes: Votes, points: Points) -> Votes:
    """Votes at points, px; outside none."""
    x, y = np.round(points[..., 0]).astype(int), np.round(points[..., 1]).astype(int)
    tall, wide = votes.shape
    inside = (x >= 0) & (x < wide) & (y >= 0) & (y < tall)
    found = votes[np.clip(y, 0, tall - 1), np.clip(x, 0, wide - 1)]
    return np.where(inside, found, np.float32(0))


def _coarse(votes: Votes, plate: PlateFormat, middle: Points) -> Points:
    """The grid's places by shift and pitch alone, px: where most votes are met."""
    step = max(0.08 * plate.pitch_mm, 0.4) * _SCALE
    reach = min(1.2 * plate.pitch_mm, 8.0) * _SCALE
    shifts = np.arange(-reach, reach + step / 2, step)
    dx, dy = np.meshgrid(shifts, shifts)
    moves = np.column_stack([dx.ravel(), dy.ravel()])
    best, where = -np.inf, middle[None]
    soft = cv2.GaussianBlur(votes, (0, 0), 0.12 * plate.pitch_mm * _SCALE)
    for stretch in _STRETCH:
        places = plate.centres() * _SCALE * stretch + middle
        met = _at(soft, places[None] + moves[:, None]).mean(axis=1)
        if met.max() > best:
            best, where = float(met.max()), places + moves[int(met.argmax())]
    return np.asarray(where)


def _peaks(
    votes: Votes, plate: PlateFormat, places: Points, reach: float
) -> tuple[Points, NDArray[np.bool_]]:
    """Where each well is seen near its place, px, and whether it is seen at all.

    Small wells are read together with their neighbours, which lie alike about their places.
    """
    offsets = np.arange(-round(reach), round(reach) + 1)
    dx, dy = np.meshgrid(offsets, offsets)
    near = np.column_stack([dx.ravel(), dy.ravel()])
    values = _at(votes, places[:, None] + near[None])
    if plate.wells >= _MANY:
        beside = 3 if plate.wells < 4 * _MANY else 5
        grid = values.reshape(plate.rows, plate.columns, -1)
        values = uniform_filter(grid, (beside, beside, 1)).reshape(values.shape)
    highest = values.max(axis=1)
    # Centre of gravity of the top of the peak: a fraction of a pixel.
    top = np.clip(values - 0.8 * highest[:, None], 0, None) + 1e-9
    moved = (top[..., None] * near[None]).sum(axis=1) / top.sum(axis=1)[:, None]
    strong = highest > max(0.35 * float(np.median(highest)), 0.5)
    return np.round(places) + moved + 0.5, strong


def _grid(plate: PlateFormat, seen: Points, strong: NDArray[np.bool_]) -> Points | None:
    """Homography from the plate to the straight picture by the wells that were seen."""
    if strong.sum() < 4:
        return None
    wells = plate.centres()[strong]
    limit = max(_WITHIN * plate.pitch_mm * _SCALE, 3.0)
    found, _ = cv2.findHomography(wells, seen[strong], cv2.RANSAC, limit)
    return None if found is None else np.asarray(found, np.float64)


def _set_right(votes: Votes, plate: PlateFormat, grid: Points) -> Points:
    """The grid, moved by whole wells if it fits better so: an outline may err by a well."""
    around = [(x, y) for x in range(-2, 3) for y in range(-2, 3)]
    moved = []
    for x, y in sorted(around, key=lambda way: abs(way[0]) + abs(way[1])):
        aside = np.eye(3)
        aside[:2, 2] = np.array([x, y]) * plate.pitch_mm
        moved.append(grid @ aside)
    return max(moved, key=lambda one: _inside_and_beyond(votes, plate, one)[0])


def _inside_and_beyond(votes: Votes, plate: PlateFormat, grid: Points) -> tuple[float, float]:
    """Votes at the grid's places, and at those just outside it on the side that has most."""
    places = plate.centres(margin=1).reshape(-1, 1, 2)
    points = cv2.perspectiveTransform(places, grid).reshape(-1, 2)
    met = _at(votes, points).reshape(plate.rows + 2, plate.columns + 2)
    sides = (met[0, 1:-1], met[-1, 1:-1], met[1:-1, 0], met[1:-1, -1])
    return float(met[1:-1, 1:-1].mean()), max(float(np.median(side)) for side in sides)


def _contrast(votes: Votes, plate: PlateFormat, grid: Points) -> float:
    """How much the grid's places stand out of the votes; 0 if it could stand one well aside."""
    inside, beyond = _inside_and_beyond(votes, plate, grid)
    return inside if beyond < _BEYOND * inside else 0.0
