"""The light of each well of a plate in a picture, and how it changed from one to another."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter

from ..types import Image
from .finding import FoundPlate

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_CORE = 0.55
"""Share of a well's radius within which its colour is read: beyond are walls and meniscus."""

_STEPS = np.linspace(-1, 1, 14)
_DISC = np.array([(x, y) for y in _STEPS for x in _STEPS if np.hypot(x, y) <= 1])
"""Points at which a disc of radius 1 is read."""

_SATURATED, _BLACK = 250, 3
"""Grey levels from which on, and up to which, a pixel tells nothing."""

_GLARE = 0.35
"""Share of a well's core that may be saturated, black or outside the picture: beyond, its colour is
not told."""

_ASIDE, _BESIDE = 0.3, 0.2
"""How far a floor may be seen aside of its well's middle, and the plate's surface between wells
aside of its place, pitches."""

_CROSSING = 1.6
"""Radius in which the surface between four wells must look even, by that in which it is read."""

_HALO_MM = 15.0
"""Pitch below which a lamp's reflection that hides a well reaches the wells beside it as well."""

_COVERED, _SHADED = 0.25, 0.8
"""Changes of the plate's own surface around a well, in colour and in light (natural logarithms,
beside the plate's median), from which something lies over it: a hand, a label, a lid."""


_LIT = 0.2
"""How much brighter than others a quarter of a well may be in the first picture (natural
logarithm): beyond, a lamp is mirrored in it."""


@dataclass(frozen=True)
class PlateLight:
    """A plate's wells in one picture, row by row from A1.

    Attributes:
        wells: Natural logarithm of the light of the four quarters of each well's core by that of
            the plate beside it, ``(wells, 4, 3)``; blue, green, red.
        beside: Natural logarithm of the light of the plate beside each well, ``(wells, 3)``.
        blinded: Whether glare, darkness or the picture's edge hides a well.
    """

    wells: Array
    beside: Array
    blinded: Flags

    def turned(self) -> PlateLight:
        """The same with A1 at the opposite corner."""
        return PlateLight(self.wells[::-1, ::-1], self.beside[::-1], self.blinded[::-1])


@dataclass(frozen=True)
class Change:
    """What changed from one picture to the other, well by well, row by row from A1.

    Attributes:
        absorbed: Light lost since, ``(wells, 4, 3)``: natural logarithm of the light of each
            quarter of a well by its surroundings' before, less the same after; blue, green, red.
            By Beer-Lambert it grows with the amount of dye over an area. Positive is darker.
        blinded: Whether glare, darkness or a thing over it hides the well in either picture.
    """

    absorbed: Array
    blinded: Flags


def plate_light(image: Image, found: FoundPlate) -> PlateLight:
    """Measure every well of a plate.

    Each is compared with the plate between the wells beside it, so that light which falls
    unevenly, and another exposure or white balance, weigh little.
    """
    plate = found.plate
    radius = _CORE * plate.radius_mm
    middles, between = plate.centres(), plate.centres(margin=1, shift=0.5)
    corner = plate.radius_mm * (2**0.5 if plate.square else 1.0)
    gap = 0.45 * (plate.pitch_mm / 2**0.5 - corner)
    if plate.square:
        middles = _most_even(image, found, middles, radius, _ASIDE)
        between = _most_even(image, found, between, _CROSSING * gap, _BESIDE)
    seen, lost = _samples(image, found, middles, radius)
    quarter = (_DISC > 0) @ (1, 2)
    wells = np.stack([np.median(seen[:, quarter == one], axis=1) for one in range(4)], axis=1)
    hidden = lost.mean(axis=1) > _GLARE
    if plate.pitch_mm < _HALO_MM:
        near = hidden.reshape(plate.rows, plate.columns).astype(np.uint8)
        hidden = cv2.dilate(near, np.ones((3, 3), np.uint8)).ravel() > 0
    light = np.median(_samples(image, found, between, gap)[0], axis=1)
    grid = light.reshape(plate.rows + 2, plate.columns + 2, 3)[:-1, :-1]
    if plate.square:
        # Outside the outer wells the surface ends in the plate's rim.
        grid = np.pad(grid[1:-1, 1:-1], ((1, 1), (1, 1), (0, 0)), mode="edge")
    around = np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, :-1], grid[1:, 1:]])
    # The mean of the middle two: one of the four may be a scratch or a glint.
    beside = np.median(around, axis=0).reshape(-1, 3)
    return PlateLight(wells - beside[:, None], beside, hidden)


def change_between(before: PlateLight, after: PlateLight) -> Change:
    """What changed in each well of a plate that was measured twice."""
    around = before.beside - after.beside
    around = around - np.median(around, axis=0)
    light = around.mean(axis=1)
    covered = np.abs(around - light[:, None]).max(axis=1) > _COVERED
    bright = before.wells.mean(axis=2).max(axis=1)
    lit = bright - np.median(bright) > _LIT
    blinded = before.blinded | after.blinded | covered | lit | (np.abs(light) > _SHADED)
    return Change(before.wells - after.wells, blinded)


def _most_even(
    image: Image, found: FoundPlate, places: Array, radius: float, aside: float
) -> Array:
    """Places near to the given ones, mm, where discs look most even.

    Wells that are deep and narrow are read on their floor. Seen aside it lies off their middle,
    and much of what is seen there is wall; their grid is not so well found either. All lie aside
    by nearly the same, so that what most of them say holds for all.
    """
    reach = np.linspace(-aside, aside, 7) * found.plate.pitch_mm
    around = np.stack(np.meshgrid(reach, reach), axis=-1).reshape(-1, 2)
    uneven = np.stack([
        np.std(_samples(image, found, places + move, radius)[0].mean(axis=2), axis=1)
        for move in around
    ], axis=-1)  # fmt: skip
    columns = len(np.unique(places[:, 0]))
    grid = uneven.reshape(-1, columns, len(around))
    together = uniform_filter(grid, (5, 5, 1)).reshape(uneven.shape)
    moved = places + around[together.argmin(axis=1)]
    limit = 0.06 * found.plate.pitch_mm
    change, _ = cv2.estimateAffine2D(places, moved, ransacReprojThreshold=limit)
    return places if change is None else places @ change[:, :2].T + change[:, 2]


def _samples(image: Image, found: FoundPlate, places: Array, radius: float) -> tuple[Array, Flags]:
    """Logarithm of the light at points of discs, ``(discs, points, 3)``, and which tell nothing."""
    disc = _DISC * radius
    at = found.pixels((places[:, None] + disc[None]).reshape(-1, 2)).astype(np.float32) - 0.5
    shape = (len(places), len(disc))
    seen = cv2.remap(image, at[:, 0].reshape(shape), at[:, 1].reshape(shape), cv2.INTER_LINEAR,
                     borderMode=cv2.BORDER_REPLICATE).astype(np.float64)  # fmt: skip
    tall, wide = image.shape[:2]
    outside = (at < 0).any(axis=1) | (at[:, 0] > wide - 1) | (at[:, 1] > tall - 1)
    brightest = seen.max(axis=2)
    lost = (brightest >= _SATURATED) | (brightest <= _BLACK) | outside.reshape(shape)
    return np.log((np.clip(seen, 1, 255) / 255) ** 2.2), lost
