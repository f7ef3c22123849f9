"""The two views of a frame that the network sees, and the way back to frame coordinates.

First the *overview*, the whole frame shrunk to a small canvas; then a *close-up* of each place
where the overview showed a tip, scaled so that the tip has always about the same size.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from ..types import Image

OVERVIEW_SIDE = 384
"""Longer side of the overview, px."""
CLOSE_UP = (96, 256)
"""Width and height of a close-up, px."""
CLOSE_UP_TIP = 160.0
"""Length of the tip in a close-up, px, if the overview measured it rightly."""
CLOSE_UP_TOP = 40.0
"""Distance of the collar from the close-up's upper edge, px."""
_MULTIPLE = 16
_SHRUNK = 0.7
"""Scale below which a turned part of a frame is made smooth before it is sampled."""


@dataclass(frozen=True)
class View:
    """A scaled part of a frame.

    Attributes:
        image: ``uint8``, BGR, both sides multiples of 16.
        scale_x, scale_y: View px per frame px.
        left, top: Frame coordinates of the view's corner, px.
    """

    image: Image
    scale_x: float
    scale_y: float
    left: float
    top: float

    def to_frame(self, x: float, y: float) -> tuple[float, float]:
        """Frame coordinates of a point of the view."""
        return x / self.scale_x + self.left, y / self.scale_y + self.top

    def from_frame(self, x: float, y: float) -> tuple[float, float]:
        """Coordinates in the view of a point of the frame."""
        return (x - self.left) * self.scale_x, (y - self.top) * self.scale_y


@dataclass(frozen=True)
class UprightView(View):
    """A part of a frame turned so that a leaning tip hangs straight down.

    Attributes:
        across, along: Unit vectors of the view's x and y in the frame.
    """

    across: tuple[float, float] = (1.0, 0.0)
    along: tuple[float, float] = (0.0, 1.0)

    def to_frame(self, x: float, y: float) -> tuple[float, float]:
        """Frame coordinates of a point of the view."""
        x, y = x / self.scale_x, y / self.scale_y
        return (
            self.left + x * self.across[0] + y * self.along[0],
            self.top + x * self.across[1] + y * self.along[1],
        )

    def from_frame(self, x: float, y: float) -> tuple[float, float]:
        """Coordinates in the view of a point of the frame."""
        x, y = x - self.left, y - self.top
        return (
            (x * self.across[0] + y * self.across[1]) * self.scale_x,
            (x * self.along[0] + y * self.along[1]) * self.scale_y,
        )


def overview(image: Image) -> View:
    """The whole frame, its longer side 384 px, padded with black on the right and below."""
    height, width = image.shape[:2]
    scale = OVERVIEW_SIDE / max(height, width)
    w, h = max(1, round(width * scale)), max(1, round(height * scale))
    mode = cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR
    small = cv2.resize(image, (w, h), interpolation=mode)
    padded = np.zeros((-(-h // _MULTIPLE) * _MULTIPLE, -(-w // _MULTIPLE) * _MULTIPLE, 3), np.uint8)
    padded[:h, :w] = small
    return View(padded, w / width, h / height, 0.0, 0.0)


def row_view(
    image: Image, collar: tuple[float, float], orifice: tuple[float, float], reach: float
) -> View:
    """A strip of the frame up to ``reach`` px on both sides of a tip, scaled as a close-up."""
    length = max(8.0, float(np.hypot(orifice[0] - collar[0], orifice[1] - collar[1])))
    scale = CLOSE_UP_TIP / length
    rows, columns = image.shape[:2]
    middle, margin = (collar[0] + orifice[0]) / 2, 0.35 * length
    x0, x1 = (int(np.clip(x, 0, columns)) for x in (middle - reach, middle + reach))
    y0, y1 = (int(np.clip(y, 0, rows)) for y in (collar[1] - margin, orifice[1] + margin))
    part = image[y0 : max(y1, y0 + 1), x0 : max(x1, x0 + 1)]
    w, h = (max(2, round(side * scale)) for side in part.shape[1::-1])
    mode = cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR
    padded = np.zeros((-(-h // _MULTIPLE) * _MULTIPLE, -(-w // _MULTIPLE) * _MULTIPLE, 3), np.uint8)
    padded[:h, :w] = cv2.resize(part, (w, h), interpolation=mode)
    return View(padded, w / part.shape[1], h / part.shape[0], float(x0), float(y0))


def close_up(image: Image, collar: tuple[float, float], orifice: tuple[float, float]) -> View:
    """The surroundings of a tip that is thought to run from ``collar`` to ``orifice``, frame px.

    What lies outside the frame is filled with the frame's border.
    """
    width, height = CLOSE_UP
    length = max(8.0, float(np.hypot(orifice[0] - collar[0], orifice[1] - collar[1])))
    scale = CLOSE_UP_TIP / length
    w, h = max(2, round(width / scale)), max(4, round(height / scale))
    left = round((collar[0] + orifice[0]) / 2 - w / 2)
    top = round((collar[1] + orifice[1]) / 2 - (CLOSE_UP_TOP + CLOSE_UP_TIP / 2) / scale)
    rows, columns = image.shape[:2]
    x0, x1 = (min(max(v, 0), columns) for v in (left, left + w))
    y0, y1 = (min(max(v, 0), rows) for v in (top, top + h))
    if x1 <= x0 or y1 <= y0:
        part = np.zeros((h, w, 3), np.uint8)
    else:
        part = image[y0:y1, x0:x1]
        margins = (y0 - top, top + h - y1, x0 - left, left + w - x1)
        if any(margins):
            part = cv2.copyMakeBorder(part, *margins, cv2.BORDER_REPLICATE)
    mode = cv2.INTER_AREA if w > width else cv2.INTER_LINEAR
    return View(
        cv2.resize(part, CLOSE_UP, interpolation=mode),
        width / w,
        height / h,
        float(left),
        float(top),
    )


def upright(image: Image, collar: tuple[float, float], orifice: tuple[float, float]) -> View:
    """As :func:`close_up`, turned so that a tip on this very axis hangs straight down."""
    width, height = CLOSE_UP
    right, down = orifice[0] - collar[0], orifice[1] - collar[1]
    length = max(8.0, float(np.hypot(right, down)))
    along, across = (right / length, down / length), (down / length, -right / length)
    scale = CLOSE_UP_TIP / length
    x, y = -width / 2 / scale, -CLOSE_UP_TOP / scale
    left = collar[0] + x * across[0] + y * along[0]
    top = collar[1] + x * across[1] + y * along[1]
    # Only the surroundings are made smooth, where they are to be shrunk.
    rows, columns = image.shape[:2]
    reach = float(np.hypot(width, height)) / scale
    x0, x1 = (int(np.clip(collar[0] + side * reach, 0, columns - 1)) for side in (-1, 1))
    y0, y1 = (int(np.clip(collar[1] + side * reach, 0, rows - 1)) for side in (-1, 1))
    part = image[y0 : y1 + 1, x0 : x1 + 1]
    if scale < _SHRUNK:
        part = np.asarray(cv2.GaussianBlur(part, (0, 0), 0.4 / scale), np.uint8)
    # cv2 puts pixel centres on integers, this project on halves.
    half = 0.5 / scale
    start = (left + half * (across[0] + along[0]), top + half * (across[1] + along[1]))
    matrix = np.array(
        [
            [across[0] / scale, along[0] / scale, start[0] - 0.5 - x0],
            [across[1] / scale, along[1] / scale, start[1] - 0.5 - y0],
        ]
    )
    pixels = cv2.warpAffine(
        part,
        matrix,
        CLOSE_UP,
        flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
        borderMode=cv2.BORDER_REPLICATE,
    )
    return UprightView(np.asarray(pixels, np.uint8), scale, scale, left, top, across, along)
