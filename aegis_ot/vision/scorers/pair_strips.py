"""Tips of one size, cut out of frames: what the pair network reads.

A strip has :data:`ROWS` rows from above the collar to below the orifice and :data:`COLUMNS` lanes
across, as much background as tip.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..column.strip import MARGIN, resample
from ..tips import TipGeometry
from ..types import Image

ROWS, COLUMNS = 112, 24

_FINE = 200
"""Rows between collar and orifice before two become one."""

U = ((np.arange(2 * ROWS) + 0.5 - round(MARGIN * _FINE)) / _FINE).reshape(ROWS, 2).mean(axis=1)
"""Where each row is: 0 collar, 1 orifice."""

_HALF = 2.0
"""Half the strip's width, outer radii of the tip's collar."""

Floats = NDArray[np.float32]


def strip_of(
    image: Image, collar: ArrayLike, orifice: ArrayLike, tip: TipGeometry
) -> NDArray[np.uint8]:
    """``(ROWS, COLUMNS, 3)`` of a frame along an axis, px."""
    half = _HALF * float(tip.outer_radius(tip.length_mm)) / tip.length_mm
    pixels, _, _ = resample(
        image, np.asarray(collar, float), np.asarray(orifice, float), _FINE, half
    )
    small = cv2.resize(pixels, (COLUMNS, ROWS), interpolation=cv2.INTER_AREA)
    strip: NDArray[np.uint8] = np.clip(small, 0, 255).astype(np.uint8)
    return strip


def wet_rows(tip: TipGeometry, slugs: Sequence[tuple[float, float]]) -> Floats:
    """1 in the rows in which liquid stands that reaches from µL to µL."""
    here = tip.volume_of(np.clip((1 - U) * tip.length_mm, 0, tip.length_mm))
    wet = np.zeros(ROWS, np.float32)
    for low, high in slugs:
        wet += (here >= low) & (here < high) & (U > 0) & (U < 1)
    return wet


def half_widths(tip: TipGeometry) -> Floats:
    """``(ROWS,)``: of the tip, as a share of the strip's half width."""
    width = tip.outer_radius(np.clip(1 - U, 0, 1) * tip.length_mm)
    return np.asarray(width / _HALF / float(tip.outer_radius(tip.length_mm)), np.float32)
