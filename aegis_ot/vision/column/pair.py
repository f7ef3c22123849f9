"""The tip before and after its dispense, in two frames at one place."""

from __future__ import annotations

from collections.abc import Mapping

import cv2
import numpy as np
from numpy.typing import NDArray

from ...vocabulary import KeyframeKind
from ..types import FREE, Axis, Image, Position
from .strip import Array, TipShape, resample

_ONE_PLACE, _HELD = 0.03, 0.15
"""How far apart both ends of a tip may be seen in two frames at one place, tip lengths; and where
the robot says that it held the tip there both times: a frame may be another robot's, replayed."""

_SAME_MM = 0.5
"""Places on the deck this close are one."""

_ABOVE, _BELOW = 0.2, 0.06
"""How far above the collar and below the nozzle's end, tip lengths, two frames are laid upon each
other: no liquid ever stands there."""

_WIDE = 1.25
"""Half the width of what is compared, outer radii: what is behind the tip does not move with it."""

_STEPS, _MOST_PX, _DONE_PX = 8, 2.5, 0.01
"""Steps of the search, how far the tip may hang from where it hung, and what ends it, px."""

_ALIKE = 0.8
"""Correlation of the two frames from which they show one thing."""


def shift_between(
    image: Image, again: Image, collar: Array, orifice: Array, shape: TipShape
) -> NDArray[np.float64] | None:
    """How far a tip hangs in a second frame from where it hung in the first, px: a robot comes
    back to a place within a tenth of a millimetre, and a wall's edge is no wider.

    ``collar``, ``orifice``: the tip's ends in the first frame. Gives what it moved to the right and
    down; ``None`` where the frames do not show one thing.
    """
    part = shape.nozzle_end + _BELOW
    down = (orifice - collar) * part
    rows = max(round(float(np.hypot(*down))), 8)
    step = np.stack([np.array([down[1], -down[0]]), down]) / rows  # of a column, of a row

    def seen(frame: Image, off: NDArray[np.float64]) -> tuple[Array, Array, Array]:
        ends, sizes = (collar + off, collar + off + down), (shape.half_width, _ABOVE)
        pixels, u, v = resample(frame, *ends, rows, *(size / part for size in sizes))
        return cv2.GaussianBlur(pixels.mean(axis=2), (0, 0), 1.0), u * part, v * part

    first, u, v = seen(image, np.zeros(2))
    inside = np.abs(v)[None, :] < _WIDE * shape.radius(u)[:, None]
    target = first[inside].astype(np.float64)
    moved = np.zeros(2)
    for _ in range(_STEPS):
        second = seen(again, moved)[0]
        lower, aside = np.gradient(second)
        seen_there = (second, np.ones_like(second), aside, lower)
        base = np.stack([plane[inside] for plane in seen_there], axis=1)
        found, *_ = np.linalg.lstsq(base.astype(np.float64), target, rcond=None)
        if found[0] <= 0.1:
            return None
        delta = (found[2:] / found[0]) @ step
        moved = moved + delta
        if np.hypot(*moved) > _MOST_PX:
            return None
        if np.hypot(*delta) < _DONE_PX:
            break
    fit = np.corrcoef(seen(again, moved)[0][inside], target)[0, 1]
    return moved if fit >= _ALIKE else None


def at_one_place(tip: Axis, again: Axis, held: bool | None = None) -> bool:
    """Whether two frames show a tip at one place, so that what stands behind it is the same; by
    its ends in both, px, and by the robot's word (``held``, see :func:`held_still`)."""
    if held is False:
        return False
    ends = np.array((tip, again), dtype=np.float64)
    length = float(np.hypot(*(ends[0, 0] - ends[0, 1])))
    reach = (_HELD if held else _ONE_PLACE) * length
    return bool((np.hypot(*(ends[0] - ends[1]).T) <= reach).all())


def held_still(positions: Mapping[KeyframeKind, Position | None]) -> bool | None:
    """Whether the robot held the tip at one place in TRANSIT and POST_DISPENSE; ``None`` where it
    did not say."""
    before, after = (positions.get(kind) for kind in FREE)
    if before is None or after is None:
        return None
    return max(abs(a - b) for a, b in zip(before, after, strict=True)) <= _SAME_MM
