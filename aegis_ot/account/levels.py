"""Where a column of liquid ends in a frame, from its volume and the tip's geometry."""

from __future__ import annotations

import numpy as np

from ..vision.tips import TipGeometry
from .wells import Axis, Box, Point

_BEYOND = 1.8
"""Half length of a mark, as a multiple of half the box's width."""


def axis_of(box: Box) -> Axis:
    """Orifice and collar of an upright tip in a box."""
    x, y, w, h = box
    return (x + w / 2, y + h), (x + w / 2, y)


def share_of(tip: TipGeometry, volume_ul: float) -> float:
    """Where a column of this volume ends: fraction of the tip's length above the orifice."""
    return float(np.clip(tip.height_of(max(volume_ul, 0.0)) / tip.length_mm, 0.0, 1.0))


def mark_at(axis: Axis, box: Box, share: float) -> tuple[Point, Point] | None:
    """Ends of a line across the tip at a fraction of its length; ``None`` at the orifice."""
    if share <= 0:
        return None
    orifice, collar = np.array(axis[0]), np.array(axis[1])
    along = collar - orifice
    length = float(np.hypot(*along))
    if length < 1:
        return None
    across = np.array([along[1], -along[0]]) / length
    across = across if across[0] >= 0 else -across
    middle = orifice + share * along
    reach = _BEYOND * box[2] / 2
    left, right = middle - reach * across, middle + reach * across
    return (float(left[0]), float(left[1])), (float(right[0]), float(right[1]))
