"""A tip of a row cut out by itself, so that no outline of its neighbours is taken for its own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..types import Image, TipDetection
from .strip import TipShape

_MARGIN = 0.35
_CLEAR_PX = 1.5


def alone(
    image: Image, detection: TipDetection, shape: TipShape
) -> tuple[Image, TipDetection, tuple[int, int]]:
    """The surroundings of a tip, its neighbours painted over with what is between them and it.

    Args:
        image: Whole frame, ``(height, width, 3)`` uint8, BGR.
        detection: The tip in it; ``apart`` says where its neighbours hang.
        shape: Outline of the tip class.

    Returns:
        A part of the frame, the tip in that part, and the part's upper left corner, px.
    """
    length, apart = detection.length, detection.apart
    assert apart is not None
    x, y = detection.collar
    height, width = image.shape[:2]
    margin = _MARGIN * length
    x0 = int(np.clip(min(x, detection.orifice[0]) - 1.5 * margin, 0, width - 2))
    x1 = int(np.clip(max(x, detection.orifice[0]) + 1.5 * margin, x0 + 2, width))
    y0 = int(np.clip(y - margin, 0, height - 2))
    y1 = int(np.clip(detection.orifice[1] + margin, y0 + 2, height))
    u = (np.arange(y0, y1) + 0.5 - y) / max(detection.orifice[1] - y, 1.0)
    axis = x + u * (detection.orifice[0] - x)
    radius = np.asarray(shape.radius(np.clip(u, 0.0, 1.0)), dtype=np.float64) * length
    reach = np.maximum(apart - radius, radius) - _CLEAR_PX
    columns = np.clip(
        np.arange(x0, x1)[None, :],
        np.ceil(axis - reach - 0.5)[:, None],
        np.floor(axis + reach - 0.5)[:, None],
    )
    columns = np.clip(columns, x0, x1 - 1).astype(np.intp) - x0
    part = image[y0:y1, x0:x1]
    cut = np.ascontiguousarray(part[np.arange(y1 - y0)[:, None], columns])
    moved = replace(
        detection,
        x=detection.x - x0,
        y=detection.y - y0,
        collar=(x - x0, y - y0),
        orifice=(detection.orifice[0] - x0, detection.orifice[1] - y0),
    )
    return cut, moved, (x0, y0)
