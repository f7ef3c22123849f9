"""How the colour of each well changed between two pictures of a plate."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from ..types import Image
from .finding import FoundPlate

Array = NDArray[np.float64]

_CORE = 0.55
"""Share of a well's radius within which its colour is read: beyond are walls and meniscus."""

_POINTS = 13
"""Points across a well at which it is read."""

_SATURATED, _BLACK = 250, 3
"""Grey levels from which on, and up to which, a pixel tells nothing."""

_GLARE = 0.35
"""Share of a well's core that may be saturated or black: beyond, its colour is not told."""


@dataclass(frozen=True)
class Change:
    """What changed from one picture to the other, well by well, row by row from A1.

    Attributes:
        absorbed: Light lost since, ``(wells, 3)``: natural logarithm of the well's light by its
            surroundings' before, less the same after; blue, green, red. By Beer-Lambert it grows
            with the amount of dye over an area. Positive is darker.
        blinded: Whether glare, or darkness, hides the well in either picture.
    """

    absorbed: Array
    blinded: NDArray[np.bool_]


def change_between(
    before: Image, found_before: FoundPlate, after: Image, found_after: FoundPlate
) -> Change:
    """Measure every well of a plate that was found in both pictures.

    Each well is compared with the plate between the wells beside it, so that light which falls
    unevenly, and another exposure or white balance, weigh little.
    """
    first, hidden_first = _relative(before, found_before)
    second, hidden_second = _relative(after, found_after)
    return Change(first - second, hidden_first | hidden_second)


def _relative(image: Image, found: FoundPlate) -> tuple[Array, NDArray[np.bool_]]:
    """Logarithm of each well's light by that of the plate around it; and whether it is hidden."""
    plate = found.plate
    wells, hidden = _light(image, found, plate.centres(), _CORE * plate.radius_mm)
    corner = plate.radius_mm * (2**0.5 if plate.square else 1.0)
    gap = 0.45 * (plate.pitch_mm / 2**0.5 - corner)
    between = plate.centres(margin=1, shift=0.5)
    light, _ = _light(image, found, between, gap)
    rows, columns = plate.rows + 2, plate.columns + 2
    grid = light.reshape(rows, columns, 3)[:-1, :-1]
    around = np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, :-1], grid[1:, 1:]])
    # The mean of the middle two: one of the four may be a scratch or a glint.
    beside = np.median(around, axis=0).reshape(-1, 3)
    return wells - beside, hidden


def _light(
    image: Image, found: FoundPlate, places: Array, radius: float
) -> tuple[Array, NDArray[np.bool_]]:
    """Logarithm of the light at discs on the plate (median), and whether they are hidden."""
    steps = np.linspace(-1, 1, _POINTS)
    x, y = np.meshgrid(steps, steps)
    disc = np.column_stack([x.ravel(), y.ravel()])
    disc = disc[np.hypot(disc[:, 0], disc[:, 1]) <= 1] * radius
    at = found.pixels((places[:, None] + disc[None]).reshape(-1, 2)).astype(np.float32) - 0.5
    shape = (len(places), len(disc))
    seen = cv2.remap(image, at[:, 0].reshape(shape), at[:, 1].reshape(shape), cv2.INTER_LINEAR,
                     borderMode=cv2.BORDER_REPLICATE).astype(np.float64)  # fmt: skip
    lost = (seen.max(axis=2) >= _SATURATED) | (seen.max(axis=2) <= _BLACK)
    linear = (np.clip(seen, 1, 255) / 255) ** 2.2
    return np.median(np.log(linear), axis=1), lost.mean(axis=1) > _GLARE
