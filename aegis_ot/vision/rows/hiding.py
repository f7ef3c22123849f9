"""How much of each tip of a row the tips before it hide."""

from __future__ import annotations

import numpy as np

from ..tips import TipGeometry
from .fit import Floats, Row

HIDDEN = 0.1
"""A tip of whose bore more than this share is covered is not observed. A choice, not a fit."""


def covered(row: Row, tip: TipGeometry, numbers: range) -> dict[int, float]:
    """Share of each tip's bore below the nozzle that nearer tips cover, by number.

    Args:
        row: Where the tips are.
        tip: Their geometry.
        numbers: Of the tips that are on the pipette.
    """
    nearer = 1 if row.taper < 0 else -1
    heights = np.linspace(0.0, tip.free_mm, 40)
    shares = {}
    for number in numbers:
        left, right = _outline(row, number, tip, heights)
        free = np.ones((len(heights), 16), bool)
        places = left[:, None] + (right - left)[:, None] * (np.arange(16) + 0.5) / 16
        for other in (number + nearer, number + 2 * nearer):
            if other in numbers:
                low, high = _outline(row, other, tip, heights)
                free &= (places < low[:, None]) | (places > high[:, None])
        shares[number] = 1.0 - float(free.mean())
    return shares


def _outline(row: Row, number: int, tip: TipGeometry, heights: Floats) -> tuple[Floats, Floats]:
    """Left and right edge of a tip at heights above its orifice, px."""
    collar_x, _, orifice_x, _ = row.ends(number)
    axis = orifice_x + (collar_x - orifice_x) * heights / tip.length_mm
    half = np.asarray(tip.outer_radius(heights)) * row.length(number) / tip.length_mm
    return axis - half, axis + half
