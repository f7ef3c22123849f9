"""Frames cut into what the network learns from: overviews and close-ups with their targets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from aegis_ot.vision.detection.decode import CHANNELS, STRIDE, VECTOR_UNIT
from aegis_ot.vision.detection.views import View, close_up, overview

from .axes import TipLabel

Image = NDArray[np.uint8]
Maps = NDArray[np.float32]
_SIGMA = 1.3  # of a heat spot, in cells
# Logarithm of the length that a tip may be taken for, in its true lengths. Without this the
# network learns that every tip in a close-up is as long as it should be, and mends no aim.
_MISTAKEN = (np.log(0.8), np.log(1.8))


@dataclass(frozen=True)
class TrainingExample:
    """A view and the tip in it, px of the view."""

    image: Image
    label: TipLabel | None

    def mirrored(self) -> TrainingExample:
        """Left and right exchanged."""
        flipped = np.ascontiguousarray(self.image[:, ::-1])
        if self.label is None:
            return TrainingExample(flipped, None)
        return TrainingExample(flipped, self.label.mapped(-1.0, 1.0, self.image.shape[1], 0.0))

    def cropped(self, rng: np.random.Generator, height: int, width: int) -> TrainingExample:
        """A part of the given size, px, around the tip where there is one; all if it is small."""
        rows, columns = self.image.shape[:2]
        if rows <= height or columns <= width:
            return self
        y, x = rng.integers(0, rows - height + 1), rng.integers(0, columns - width + 1)
        if self.label is not None and rng.random() < 0.9:
            cx = (self.label.collar[0] + self.label.orifice[0]) / 2
            cy = (self.label.collar[1] + self.label.orifice[1]) / 2
            y = int(np.clip(cy - height * rng.uniform(0.3, 0.7), 0, rows - height))
            x = int(np.clip(cx - width * rng.uniform(0.1, 0.9), 0, columns - width))
        part = np.ascontiguousarray(self.image[y : y + height, x : x + width])
        label = None if self.label is None else self.label.mapped(1.0, 1.0, -float(x), -float(y))
        return TrainingExample(part, label)


def _in_view(view: View, label: TipLabel | None) -> TipLabel | None:
    if label is None:
        return None
    return label.mapped(
        view.scale_x, view.scale_y, -view.left * view.scale_x, -view.top * view.scale_y
    )


def overview_example(image: Image, label: TipLabel | None) -> TrainingExample:
    """The whole frame as the detector's first look sees it."""
    view = overview(image)
    return TrainingExample(view.image, _in_view(view, label))


def close_up_example(
    rng: np.random.Generator, image: Image, label: TipLabel | None, decoy: TipLabel | None
) -> TrainingExample:
    """A close-up about as wrong as the first look may aim it.

    Without a tip it shows the bare nozzle (``decoy``) two times in three, or any place.
    """
    height, width = image.shape[:2]
    aim = label or (decoy if rng.random() < 0.67 else None)
    if aim is None or (label is not None and rng.random() < 0.05):
        length = np.exp(rng.uniform(np.log(40), np.log(0.8 * height)))
        x, y = rng.uniform(0, width), rng.uniform(0, height - length)
        collar, orifice = np.array([x, y]), np.array([x, y + length])
    else:
        collar, orifice = np.array(aim.collar), np.array(aim.orifice)
        length = aim.length
        if rng.random() < 0.4:  # the overview took the tip for shorter, or much longer
            orifice = collar + (orifice - collar) * np.exp(rng.uniform(*_MISTAKEN))
        wide = 1.0 if label is not None else 3.0
        collar = collar + rng.normal(0, 0.045 * wide, 2) * length
        orifice = orifice + rng.normal(0, 0.045 * wide, 2) * length
        if orifice[1] - collar[1] < 0.3 * length:
            orifice = collar + np.array([0.0, length])
    view = close_up(
        image, (float(collar[0]), float(collar[1])), (float(orifice[0]), float(orifice[1]))
    )
    seen = _in_view(view, label)
    if seen is not None:
        rows, columns = view.image.shape[:2]
        inside = all(0 <= x <= columns and 0 <= y <= rows for x, y in (seen.collar, seen.orifice))
        if not inside:
            seen = None
    return TrainingExample(view.image, seen)


def targets(rows: int, columns: int, label: TipLabel | None) -> tuple[Maps, Maps]:
    """What the network should say, and how much each cell's geometry matters.

    Args:
        rows, columns: Size of the maps, cells.
        label: The tip, px of the view.

    Returns:
        Maps ``(7, rows, columns)`` as in :mod:`aegis_ot.vision.detection.decode`, and weights
        ``(1, rows, columns)`` of the five geometry maps, 0 away from the two points.
    """
    maps = np.zeros((CHANNELS, rows, columns), np.float32)
    weight = np.zeros((1, rows, columns), np.float32)
    if label is None:
        return maps, weight
    nearest = np.zeros((rows, columns), np.float32)
    for tip in (label, *label.beside):
        _paint(maps, nearest, tip)
    weight[0] = np.where(nearest < 0.2, 0.0, nearest)
    return maps, weight


def _paint(maps: Maps, nearest: Maps, tip: TipLabel) -> None:
    """Add one tip; each cell speaks of the end that it is nearest to, over all tips."""
    _, rows, columns = maps.shape
    xs = (np.arange(columns) + 0.5) * STRIDE
    ys = (np.arange(rows) + 0.5) * STRIDE
    for kind, (x, y) in enumerate((tip.collar, tip.orifice)):
        dx, dy = x - xs[None, :], y - ys[:, None]
        heat = np.exp(-(dx**2 + dy**2) / (2 * (_SIGMA * STRIDE) ** 2))
        nearer = heat > nearest
        maps[kind] = np.maximum(maps[kind], heat)
        row, column = int(np.floor(y / STRIDE)), int(np.floor(x / STRIDE))
        if 0 <= row < rows and 0 <= column < columns:
            maps[kind][row, column] = 1.0
        maps[2][nearer] = np.broadcast_to(dx, heat.shape)[nearer]
        maps[3][nearer] = np.broadcast_to(dy, heat.shape)[nearer]
        maps[4][nearer] = (tip.orifice[0] - tip.collar[0]) / VECTOR_UNIT
        maps[5][nearer] = (tip.orifice[1] - tip.collar[1]) / VECTOR_UNIT
        maps[6][nearer] = np.log(max(tip.radius, 0.5))
        nearest[nearer] = heat[nearer]
