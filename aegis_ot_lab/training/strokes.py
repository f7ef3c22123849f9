"""Drawing with sub-pixel edges, and the axis that a pipette is drawn along."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

Image = NDArray[np.uint8]
Points = NDArray[np.float64]
Colour = NDArray[np.float64]

_SHIFT = 4  # fractional bits of OpenCV's sub-pixel drawing coordinates


def polygon(canvas: Image, points: Points, colour: float | list[float]) -> None:
    """Fill a polygon, points ``(n, 2)`` in px."""
    # OpenCV counts from the centre of the first pixel, the project from its corner.
    fixed = np.round((points - 0.5) * (1 << _SHIFT)).astype(np.int32)
    cv2.fillPoly(canvas, [fixed], colour, cv2.LINE_AA, _SHIFT)


def random_colour(rng: np.random.Generator, low: float, high: float, chroma: float) -> Colour:
    """BGR of a grey level from ``low`` to ``high``, each channel off by up to ``chroma``."""
    grey = rng.uniform(low, high)
    return np.clip(grey * (1 + rng.uniform(-chroma, chroma, 3)), 0, 255)


def paint(image: Image, outline: Points, colour: Colour, alpha: float) -> None:
    """Lay a see-through polygon over the image."""
    low = np.floor(outline.min(axis=0)).astype(int) - 2
    high = np.ceil(outline.max(axis=0)).astype(int) + 2
    x0, y0 = np.maximum(low, 0)
    x1, y1 = np.minimum(high, [image.shape[1], image.shape[0]])
    if x1 <= x0 or y1 <= y0:
        return
    mask = np.zeros((y1 - y0, x1 - x0), np.uint8)
    polygon(mask, outline - [x0, y0], 255)
    weight = mask.astype(np.float32)[..., None] * (alpha / 255)
    part = image[y0:y1, x0:x1]
    image[y0:y1, x0:x1] = (
        part * (1 - weight) + np.asarray(colour, np.float32) * weight + 0.5
    ).astype(np.uint8)


class Axis:
    """Maps distances along and across a hanging pipette to image coordinates.

    Args:
        foot: Where the distances are 0, px.
        angle: Lean of the pipette from the vertical, rad.
    """

    def __init__(self, foot: NDArray[np.float64], angle: float) -> None:
        self.foot = foot
        self.down = np.array([np.sin(angle), np.cos(angle)])
        self.side = np.array([np.cos(angle), -np.sin(angle)])

    def at(self, along: ArrayLike, across: ArrayLike) -> NDArray[np.float64]:
        """Points ``along`` px below the collar and ``across`` px to the right, ``(n, 2)``."""
        a, b = np.broadcast_arrays(np.atleast_1d(along), np.atleast_1d(across))
        points: Points = self.foot + a[:, None] * self.down + b[:, None] * self.side
        return points

    def strip(
        self, along: ArrayLike, half: ArrayLike, offset: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Closed outline of a body of half-widths ``half`` at ``along``."""
        a, h, o = np.broadcast_arrays(
            np.atleast_1d(along), np.atleast_1d(half), np.atleast_1d(offset)
        )
        return np.concatenate([self.at(a, o - h), self.at(a[::-1], (o + h)[::-1])])
