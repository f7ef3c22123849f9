"""The axis of a tip in a frame, refined from a detection.

A detection is good to a few pixels, now and then to a few dozen; a column of 25 µL in a p1000
tip is nine pixels long, and in a p20 tip the whole bore is two pixels wide. So the axis is
refined on the tip's own outline, and its ends on two marks: the lower end of the nozzle, which
shows through the tip as a sharp step in every frame, and the orifice, where the tip ends.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from ..types import Image, TipDetection
from .strip import Array, Point, Strip, TipShape, resample

_REACH = 0.08
"""How far from where it should be the nozzle's end is looked for, tip lengths: farther down is the
lower end of a real tip's sleeve, which is a sharper step."""

_CLEAR = 4.0
"""What a step must be to stand out, times the noise."""

_COARSE, _FINE = (0.06, 1.0), (0.02, 0.25)
"""How far both ends are shifted across the axis, tip lengths, and in what steps, rows."""

_SIDEWAYS = 0.03
"""Standard deviation of a detection's ends across the axis, tip lengths (a box has no axis, and a
tip leans). Labware has edges too: without clear reason the axis stays where it was."""


def rectify(
    image: Image, detection: TipDetection, shape: TipShape, *, length: float | None = None
) -> Strip:
    """Lay the detected tip straight.

    Args:
        image: Whole frame, ``(height, width, 3)`` uint8, BGR.
        detection: The tip in it. Errors across the axis up to a tip's width are mended, along
            it a few per cent of the tip.
        shape: Outline of the tip class.
        length: Length of the tip in px, where it is known better than from this detection.
    """
    collar = np.array(detection.collar, dtype=np.float64)
    orifice = np.array(detection.orifice, dtype=np.float64)
    collar, orifice, clarity = onto_outline(image, collar, orifice, shape)
    shift = nozzle_shift(image, collar, orifice, shape)
    collar = collar + (orifice - collar) * (shift or 0.0)
    if length is not None:
        collar, orifice = _of_length(image, collar, orifice, shape, length)
        collar, orifice, clarity = onto_outline(image, collar, orifice, shape)
    orifice = orifice + (orifice - collar) * _orifice_shift(image, collar, orifice, shape)
    pixels, u, v = resample(image, collar, orifice, shape.rows, shape.half_width)
    return Strip(
        pixels,
        u,
        v,
        (float(collar[0]), float(collar[1])),
        (float(orifice[0]), float(orifice[1])),
        clarity,
    )


def _of_length(
    image: Image, collar: Point, orifice: Point, shape: TipShape, length: float
) -> tuple[Point, Point]:
    """The same axis made ``length`` px long: of its two ends, the one is kept that fits better.

    The nozzle shows in every frame, so it says which.
    """
    along = orifice - collar
    along = along * (length / max(float(np.hypot(*along)), 1.0))
    choices = ((collar, collar + along), (orifice - along, orifice))
    shift = [nozzle_shift(image, top, end, shape) for top, end in choices]
    best = 1 if shift[0] is None and shift[1] is not None else 0
    step = along * (shift[best] or 0.0)
    return choices[best][0] + step, choices[best][1] + step


def clarities(
    image: Image, detection: TipDetection, shapes: Sequence[TipShape]
) -> tuple[float, ...]:
    """How well each of the outlines that a kind of tip may have lies on the steepest steps."""
    collar, orifice = np.array(detection.collar), np.array(detection.orifice)
    widest = max(shape.half_width for shape in shapes)
    return tuple(_shifted(image, collar, orifice, shape, widest, *_COARSE)[2] for shape in shapes)


def onto_outline(
    image: Image,
    collar: Point,
    orifice: Point,
    shape: TipShape,
) -> tuple[Point, Point, float]:
    """Shift both ends across the axis until the tip's outline lies on the steepest steps."""
    collar, orifice, _ = _shifted(image, collar, orifice, shape, shape.half_width, *_COARSE)
    return _shifted(image, collar, orifice, shape, shape.half_width, *_FINE)


def _shifted(
    image: Image,
    collar: Point,
    orifice: Point,
    shape: TipShape,
    half_width: float,
    reach: float,
    fine: float,
) -> tuple[Point, Point, float]:
    """The ends where the outline fits best, up to ``reach`` tip lengths aside, and how well.

    ``half_width``: of the strip on which steps are looked for; ``fine``: of the shifts, rows.
    """
    rows = 96
    pixels, u, v = resample(image, collar, orifice, rows, half_width + 2 * reach)
    grey = cv2.GaussianBlur(pixels.mean(axis=2), (1, 5), 0)
    step = np.abs(np.gradient(grey, axis=1))
    noise = np.median(step) + 1e-3
    step = np.minimum(step / noise, 12.0)
    inside = (u > 0.0) & (u < 1.0)
    grid = np.arange(-reach, reach + 1e-9, fine / rows)
    rows_u = u[inside].astype(np.float64)
    radius = shape.radius(u[inside]).astype(np.float64)
    table = step[inside]
    height, width = table.shape
    # (height, grid, grid): centre of the axis per row for every shift of upper and lower end
    centre = (
        grid[None, :, None] * (1 - rows_u)[:, None, None]
        + grid[None, None, :] * rows_u[:, None, None]
    )
    values = np.ascontiguousarray(table).ravel()
    first = np.arange(0, height * width, width)[:, None, None]
    total = np.zeros((grid.size, grid.size))
    for side in (-1.0, 1.0):
        at = (centre + (side * radius - v[0])[:, None, None]) * rows
        low = np.clip(at.astype(np.intp), 0, width - 2)
        part = np.clip(at - low, 0.0, 1.0)
        low += first
        here = values.take(low)
        total += (here + (values.take(low + 1) - here) * part).sum(axis=0)
    off = 0.25 * (grid / _SIDEWAYS) ** 2
    total -= 2 * height * (off[:, None] + off[None, :])
    best = np.unravel_index(int(np.argmax(total)), total.shape)
    along = orifice - collar
    across = np.array([along[1], -along[0]])
    clarity = float(total[best] / (2 * height))
    return collar + across * grid[best[0]], orifice + across * grid[best[1]], clarity


def nozzle_shift(image: Image, collar: Point, orifice: Point, shape: TipShape) -> float | None:
    """How far down the axis the nozzle ends from where it should, tip lengths.

    ``None`` if no step within reach stands out from the noise.
    """
    grey, u, v = _grey(image, collar, orifice, shape, _REACH + 0.05)
    bore = grey[:, np.abs(v) < 0.6 * shape.collar_radius].mean(axis=1)
    found = _step(u, -bore, shape.nozzle_end, _REACH, 3)
    return None if found is None else found - shape.nozzle_end


def _orifice_shift(image: Image, collar: Point, orifice: Point, shape: TipShape) -> float:
    """How far down the axis the tip ends from where it should, tip lengths; 0 if unclear.

    Beyond the orifice the middle of the strip looks like its sides.
    """
    grey, u, v = _grey(image, collar, orifice, shape, 0.12)
    tip = np.abs(v) < 1.2 * shape.orifice_radius
    side = (np.abs(v) > 2.5 * shape.orifice_radius) & (np.abs(v) < shape.collar_radius)
    beside = np.median(grey[:, side], axis=1)
    contrast = np.abs(grey[:, tip].mean(axis=1) - grey[:, side].mean(axis=1))
    contrast = cv2.GaussianBlur(contrast[:, None], (1, 3), 0)[:, 0]
    end = _step(u, -contrast, 1.0, 0.04, 4)
    if end is None:
        return 0.0
    # An edge in the background beside the tip may be what ends there.
    behind = np.ptp(beside[np.abs(u - 1.0) < 0.06])
    return 0.0 if behind > 0.5 * np.max(contrast[np.abs(u - 0.97) < 0.03]) else end - 1.0


def _grey(
    image: Image, collar: Point, orifice: Point, shape: TipShape, margin: float
) -> tuple[Array, Array, Array]:
    pixels, u, v = resample(image, collar, orifice, shape.rows, shape.half_width, margin)
    return np.asarray(pixels.mean(axis=2), dtype=np.float32), u, v


def _step(u: Array, profile: Array, expected: float, reach: float, width: int) -> float | None:
    """Sub-row position of the steepest rise of a profile near ``expected``, or ``None``."""
    kernel = np.concatenate([np.full(width, -1.0), np.full(width, 1.0)]) / width
    rise = np.correlate(profile.astype(np.float64), kernel, mode="same")
    near = np.flatnonzero(np.abs(u - expected) <= reach)
    # A weak prior on the detection: a step twice as far off has to be clearly steeper.
    weight = np.exp(-0.5 * ((u[near] - expected) / reach) ** 2)
    best = int(near[np.argmax(rise[near] * weight)])
    noise = 1.48 * float(np.median(np.abs(rise - np.median(rise)))) + 1e-6
    if rise[best] < _CLEAR * noise or best in (0, len(u) - 1):
        return None
    left, mid, right = rise[best - 1], rise[best], rise[best + 1]
    bend = left - 2 * mid + right
    shift = 0.5 * (left - right) / bend if bend < 0 else 0.0
    # correlate(mode="same") puts an even kernel's centre half a row above the row it names
    return float(u[best] + (np.clip(shift, -0.5, 0.5) - 0.5) * (u[1] - u[0]))
