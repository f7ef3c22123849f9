"""What one frame tells about its camera, whatever it shows."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from ..types import Image

Blocks = NDArray[np.float32]
"""Mean brightness of the frame's blocks, ``(rows, BLOCKS_ACROSS)``, grey levels 0 to 255."""

BLOCKS_ACROSS = 96
_CLIPPED = 250.0
_LINES, _QUOTED = 240, 480
"""Frames are brought to so many lines before edges are measured, so that px mean the same and the
robot does not wait; widths are quoted in px of a frame of 480 lines."""

_FINE, _COARSE = 0.8, 2.4
"""Widths of the two filters whose answers to an edge tell how wide it is, px."""

_STRONG = 99.5
"""Percentile of the coarse gradient from which a pixel counts as an edge."""

_SHARPEST = 90
"""Percentile of the edges' sharpness that is the frame's: what is out of focus behind the pipette
does not count against it."""

_SURROUNDINGS = 6.0
"""Blocks over which what is smooth is taken away before contrast is measured."""


@dataclass(frozen=True)
class ViewMeasures:
    """One frame in few numbers.

    Attributes:
        blocks: See :data:`Blocks`.
        brightest: 99th percentile of the blocks, grey levels.
        clipped: Share of the blocks that are white to the limit, 0 to 1.
        contrast: How much the most contrasting blocks differ from their surroundings, grey levels.
        edge_px: Width of the sharpest edges (standard deviation of the blur), px of a frame of
            480 lines.
    """

    blocks: Blocks
    brightest: float
    clipped: float
    contrast: float
    edge_px: float


def measure_view(image: Image) -> ViewMeasures:
    """Measure one frame, BGR ``(height, width, 3)``; takes a few ms."""
    grey = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    blocks = blocks_of(grey)
    smooth = cv2.GaussianBlur(blocks, (0, 0), _SURROUNDINGS)
    return ViewMeasures(
        blocks,
        float(np.percentile(blocks, 99)),
        float((blocks >= _CLIPPED).mean()),
        float(np.percentile(np.abs(blocks - smooth), 99)),
        edge_width(grey),
    )


def blocks_of(grey: NDArray[np.uint8]) -> Blocks:
    """The frame in blocks, whatever its size."""
    rows = max(2, round(BLOCKS_ACROSS * grey.shape[0] / grey.shape[1]))
    size = (BLOCKS_ACROSS, rows)
    return np.asarray(
        cv2.resize(grey.astype(np.float32), size, interpolation=cv2.INTER_AREA), dtype=np.float32
    )


def edge_width(grey: NDArray[np.uint8]) -> float:
    """Blur of the sharpest edges, px: a filter of width s answers to an edge of width b with
    a gradient in proportion to 1 / sqrt(b² + s²), so the answers of two give b."""
    factor = _LINES / grey.shape[0]
    if factor < 1.0:
        size = (max(2, round(grey.shape[1] * factor)), _LINES)
        grey = np.asarray(cv2.resize(grey, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
    fine, coarse = (_gradient(grey, width) for width in (_FINE, _COARSE))
    strong = coarse >= max(float(np.percentile(coarse, _STRONG)), 1e-3)
    if not strong.any():
        return float("inf")
    ratio = float(np.percentile(fine[strong] / coarse[strong], _SHARPEST)) ** 2
    if ratio <= 1.0:
        return float("inf")
    width = np.sqrt(max((_COARSE**2 - ratio * _FINE**2) / (ratio - 1.0), 0.0))
    return float(width) * _QUOTED / _LINES


def _gradient(grey: NDArray[np.uint8], width: float) -> NDArray[np.float32]:
    smooth = cv2.GaussianBlur(grey.astype(np.float32), (0, 0), width)
    across = cv2.Sobel(smooth, cv2.CV_32F, 1, 0, ksize=3)
    along = cv2.Sobel(smooth, cv2.CV_32F, 0, 1, ksize=3)
    return np.asarray(cv2.magnitude(across, along), dtype=np.float32)
