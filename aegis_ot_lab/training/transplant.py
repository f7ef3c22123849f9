"""Pipettes of recorded frames before other rooms.

A data set's plates show few rooms, and a detector would learn them. The pipette moves and the
room does not, so the median over a plate is the empty room, and what differs from it is the
pipette: it can be put before any other background. The tip lets the new room shine through.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from .axes import TipLabel
from .strokes import Image

_DIFFERENT = 14.0  # grey levels from which a pixel is no longer the empty room


def transplanted(
    rng: np.random.Generator,
    image: Image,
    room: Image,
    other: Image,
    label: TipLabel | None,
) -> Image:
    """The pipette of a frame before another room.

    Args:
        rng: Source of every choice.
        image: The recorded frame, BGR.
        room: The same view without the pipette.
        other: The new background, of the same size.
        label: The tip, if there is one; what else differs from the room is opaque.
    """
    lit = image.astype(np.float32) - room
    change = cv2.GaussianBlur(np.abs(lit).max(axis=2), (0, 0), 1.0)
    solid = (change > _DIFFERENT).astype(np.uint8)
    solid = cv2.morphologyEx(solid, cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8))
    solid = cv2.morphologyEx(solid, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    # A pipette hangs from above; what changed elsewhere is shadow, reflection or liquid.
    cover = _hanging(solid, label).astype(np.float32)
    if label is not None:
        inside = np.zeros(solid.shape, np.uint8)
        for tip in (label, *label.beside):
            cv2.fillPoly(inside, [np.round(_outline(tip)).astype(np.int32)], 1)
        cover = np.where(inside > 0, rng.uniform(0.15, 0.7) + 0 * cover, cover)
    cover = cv2.GaussianBlur(cover, (0, 0), 0.7)[..., None]
    clear = other * (1 - cover)
    seen = clear + image * cover
    if label is not None:  # the tip's own light: glints, frosting, and what it holds
        glow = cv2.GaussianBlur(inside.astype(np.float32), (0, 0), 0.7)[..., None]
        seen += glow * (1 - cover) * np.maximum(lit, -0.6 * other)
    shown: Image = np.clip(seen, 0, 255).astype(np.uint8)
    return shown


def _hanging(solid: NDArray[np.uint8], label: TipLabel | None) -> NDArray[np.bool_]:
    """The largest part of the mask that reaches the frame's top or the tip's collar."""
    count, parts, stats, _ = cv2.connectedComponentsWithStats(solid, connectivity=8)
    touching = set(np.unique(parts[:2]))
    if label is not None:
        x, y = int(label.collar[0]), int(label.collar[1])
        r = max(2, int(label.radius))
        around = parts[max(0, y - 3 * r) : y + r, max(0, x - r) : x + r + 1]
        touching |= set(np.unique(around))
    touching &= set(range(1, count))
    if not touching:
        return np.zeros(solid.shape, bool)
    kept = max(touching, key=lambda part: int(stats[part, cv2.CC_STAT_AREA]))
    found: NDArray[np.bool_] = parts == kept
    return found


def _outline(label: TipLabel) -> NDArray[np.float64]:
    """A tip-shaped polygon around the axis, px."""
    collar, orifice = np.array(label.collar), np.array(label.orifice)
    down = (orifice - collar) / max(label.length, 1e-6)
    side = np.array([down[1], -down[0]])
    points = [
        collar + side * label.radius,
        collar + 0.2 * (orifice - collar) + side * label.radius,
        orifice + side * 0.35 * label.radius,
    ]
    mirrored = [p - 2 * side * np.dot(p - collar, side) for p in reversed(points)]
    return np.array(points + mirrored)
