"""A tip cut out of a frame and laid straight: rows run along its axis, columns across it.

A detection is good to a few pixels; a column of 25 µL in a p1000 tip is nine pixels long, and
in a p20 tip the whole bore is two pixels wide. So the axis is refined first, on the tip's own
outline, and the rows are anchored to the lower end of the nozzle, which shows through the tip
as a sharp step in every frame.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from ..types import Image, TipDetection

Array = NDArray[np.float32]

MARGIN = 0.06
"""How far the strip reaches beyond collar and orifice, in tip lengths."""


@dataclass(frozen=True)
class TipShape:
    """The outline of a tip class in units of its length, collar (0) to orifice (1).

    Attributes:
        name: Short tip class, ``"p1000"``.
        rows: Rows of a strip from collar to orifice; about 1.3 times the usual length in px.
        collar_radius: Outer radius at the collar, tip lengths.
        orifice_radius: Outer radius at the orifice, tip lengths.
        nozzle_end: Where the pipette's nozzle ends inside the tip, tip lengths below the collar.
    """

    name: str
    rows: int
    collar_radius: float
    orifice_radius: float
    nozzle_end: float

    @property
    def half_width(self) -> float:
        """Half the width of a strip, tip lengths: the tip and as much background beside it."""
        return 2.0 * self.collar_radius

    def radius(self, u: Array) -> Array:
        """Outer radius at ``u`` (0 collar, 1 orifice), tip lengths; straight taper."""
        inside = np.clip(u, 0.0, 1.0)
        return (self.collar_radius + (self.orifice_radius - self.collar_radius) * inside).astype(
            np.float32
        )


# Lengths and nozzle overlaps are Opentrons' own (labware definitions 2/opentrons_96_tiprack_*);
# radii are measured on the tips.
SHAPES = {
    "p1000": TipShape("p1000", 240, 0.0440, 0.0095, 0.0815),
    "p300": TipShape("p300", 180, 0.0560, 0.0105, 0.125),
    "p20": TipShape("p20", 120, 0.0640, 0.0130, 0.155),
}


@dataclass(frozen=True)
class Strip:
    """A tip laid straight.

    Attributes:
        pixels: ``(rows, columns, 3)`` float32, BGR, 0 to 255; row 0 is ``MARGIN`` above the
            collar, the middle column is the axis.
        u: ``(rows,)`` position of each row's centre: 0 collar, 1 orifice.
        v: ``(columns,)`` position of each column's centre across the axis, tip lengths.
        collar: Refined upper end of the axis, px of the frame.
        orifice: Refined lower end of the axis, px of the frame.
        clarity: Share of the outline's contrast that the refined axis explains; low values
            mean that the tip was hardly to be seen.
    """

    pixels: Array
    u: Array
    v: Array
    collar: tuple[float, float]
    orifice: tuple[float, float]
    clarity: float

    @property
    def length(self) -> float:
        """Length of the tip in the frame, px."""
        return float(np.hypot(self.orifice[0] - self.collar[0], self.orifice[1] - self.collar[1]))


def rectify(
    image: Image, detection: TipDetection, shape: TipShape, *, refine: bool = True
) -> Strip:
    """Lay the detected tip straight.

    Args:
        image: Whole frame, ``(height, width, 3)`` uint8, BGR.
        detection: The tip in it; errors up to about a tip's width are mended.
        shape: Outline of the tip class.
        refine: Whether to refine the axis on the image first.
    """
    collar = np.array(detection.collar, dtype=np.float64)
    orifice = np.array(detection.orifice, dtype=np.float64)
    clarity = 1.0
    if refine:
        collar, orifice, clarity = _refine_axis(image, collar, orifice, shape)
        collar, orifice = _anchor(image, collar, orifice, shape)
    pixels, u, v = _sample(image, collar, orifice, shape, shape.rows, shape.half_width)
    return Strip(
        pixels,
        u,
        v,
        (float(collar[0]), float(collar[1])),
        (float(orifice[0]), float(orifice[1])),
        clarity,
    )


def _sample(
    image: Image,
    collar: NDArray[np.float64],
    orifice: NDArray[np.float64],
    shape: TipShape,
    rows: int,
    half_width: float,
    margin: float = MARGIN,
) -> tuple[Array, Array, Array]:
    """Resample the frame along an axis; returns pixels, u and v."""
    extra = round(margin * rows)
    n = rows + 2 * extra
    step = 1.0 / rows
    columns = 2 * round(half_width / step) + 1
    u = ((np.arange(n) + 0.5 - extra) * step).astype(np.float32)
    v = ((np.arange(columns) - columns // 2) * step).astype(np.float32)
    along = orifice - collar
    across = np.array([along[1], -along[0]])  # to the right in the frame when the tip hangs down
    # dst (column, row) -> src (x, y); cv2 puts pixel centres on integers, this project on halves.
    matrix = np.array(
        [
            [across[0] * step, along[0] * step, 0.0],
            [across[1] * step, along[1] * step, 0.0],
        ]
    )
    start = collar + along * float(u[0]) + across * float(v[0]) - 0.5
    matrix[:, 2] = start
    x0 = int(np.floor(min(collar[0], orifice[0]) - half_width * np.hypot(*along))) - 8
    y0 = int(np.floor(min(collar[1], orifice[1]) - margin * np.hypot(*along))) - 8
    x1 = int(np.ceil(max(collar[0], orifice[0]) + half_width * np.hypot(*along))) + 8
    y1 = int(np.ceil(max(collar[1], orifice[1]) + margin * np.hypot(*along))) + 8
    x0, y0 = max(0, min(x0, image.shape[1] - 2)), max(0, min(y0, image.shape[0] - 2))
    x1, y1 = max(x0 + 2, min(x1, image.shape[1])), max(y0 + 2, min(y1, image.shape[0]))
    matrix[:, 2] -= (x0, y0)
    patch = image[y0:y1, x0:x1].astype(np.float32)
    pixels = cv2.warpAffine(
        patch,
        matrix,
        (columns, n),
        flags=cv2.INTER_CUBIC | cv2.WARP_INVERSE_MAP,
        borderMode=cv2.BORDER_REPLICATE,
    )
    return np.asarray(pixels, dtype=np.float32), u, v


def _refine_axis(
    image: Image,
    collar: NDArray[np.float64],
    orifice: NDArray[np.float64],
    shape: TipShape,
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Shift both ends across the axis until the tip's outline lies on the steepest steps."""
    clarity = 0.0
    for reach, fine in ((0.06, 1.0), (0.02, 0.25)):
        rows = 96
        pixels, u, v = _sample(image, collar, orifice, shape, rows, shape.half_width + 2 * reach)
        grey = cv2.GaussianBlur(pixels.mean(axis=2), (1, 5), 0)
        step = np.abs(np.gradient(grey, axis=1))
        noise = np.median(step) + 1e-3
        step = np.minimum(step / noise, 12.0)
        inside = (u > 0.0) & (u < 1.0)
        grid = np.arange(-reach, reach + 1e-9, fine / rows)
        rows_u = u[inside].astype(np.float64)
        radius = shape.radius(u[inside]).astype(np.float64)
        table = step[inside]
        total = np.zeros((grid.size, grid.size))
        height, width = table.shape
        index = np.arange(height)[:, None]
        for i, top in enumerate(grid):
            # (height, grid): centre of the axis per row for every shift of the lower end
            centre = top * (1 - rows_u)[:, None] + grid[None, :] * rows_u[:, None]
            for side in (-1.0, 1.0):
                at = (centre + side * radius[:, None] - v[0]) * rows
                low = np.clip(at.astype(np.int64), 0, width - 2)
                part = np.clip(at - low, 0.0, 1.0)
                total[i] += (table[index, low] * (1 - part) + table[index, low + 1] * part).sum(0)
        best = np.unravel_index(int(np.argmax(total)), total.shape)
        along = orifice - collar
        across = np.array([along[1], -along[0]])
        collar = collar + across * grid[best[0]]
        orifice = orifice + across * grid[best[1]]
        clarity = float(total[best] / (2 * height))
    return collar, orifice, clarity


def _anchor(
    image: Image,
    collar: NDArray[np.float64],
    orifice: NDArray[np.float64],
    shape: TipShape,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Slide the axis ends along the axis onto the nozzle's lower end and the orifice.

    An end whose step is not clear of the noise keeps the place that the detection gave it.
    """
    along = orifice - collar
    pixels, u, v = _sample(image, collar, orifice, shape, shape.rows, shape.half_width, 0.12)
    grey = pixels.mean(axis=2)
    bore = grey[:, np.abs(v) < 0.6 * shape.collar_radius].mean(axis=1)
    nozzle = _step(u, -bore, shape.nozzle_end, 0.05, 3)
    if nozzle is None:
        return collar, orifice
    # Beyond the orifice the middle of the strip looks like its sides.
    tip = np.abs(v) < 1.2 * shape.orifice_radius
    side = (np.abs(v) > 2.5 * shape.orifice_radius) & (np.abs(v) < shape.collar_radius)
    contrast = np.abs(cv2.GaussianBlur(grey[:, tip].mean(1) - grey[:, side].mean(1), (1, 3), 0))
    end = _step(u, -contrast.ravel(), 1.0, 0.04, 4)
    beside = np.median(grey[:, side], axis=1)[np.abs(u - 1.0) < 0.06]
    if end is not None and np.ptp(beside) > 0.5 * np.max(contrast[np.abs(u - 0.97) < 0.03]):
        end = None  # an edge in the background, not the tip's
    top = nozzle - shape.nozzle_end
    bottom = 0.0 if end is None else end - 1.0
    return collar + along * top, orifice + along * bottom


def _step(u: Array, profile: Array, expected: float, reach: float, width: int) -> float | None:
    """Sub-row position of the steepest rise of a profile near ``expected``, or ``None``."""
    kernel = np.concatenate([np.full(width, -1.0), np.full(width, 1.0)]) / width
    rise = np.correlate(profile.astype(np.float64), kernel, mode="same")
    rise = np.roll(rise, 0)
    near = np.flatnonzero(np.abs(u - expected) <= reach)
    # A weak prior on the detection: a step twice as far off has to be clearly steeper.
    weight = np.exp(-0.5 * ((u[near] - expected) / reach) ** 2)
    best = int(near[np.argmax(rise[near] * weight)])
    noise = 1.48 * float(np.median(np.abs(rise - np.median(rise)))) + 1e-6
    if rise[best] < 4.0 * noise or best in (0, len(u) - 1):
        return None
    left, mid, right = rise[best - 1], rise[best], rise[best + 1]
    bend = left - 2 * mid + right
    shift = 0.5 * (left - right) / bend if bend < 0 else 0.0
    # correlate(mode="same") puts an even kernel's centre half a row above the row it names
    return float(u[best] + (np.clip(shift, -0.5, 0.5) - 0.5) * (u[1] - u[0]))
