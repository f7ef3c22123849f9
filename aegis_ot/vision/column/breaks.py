"""Breaks in a liquid column: air gaps and bubbles that span the bore.

Within a gap the tip looks empty again. So the row's brightness goes back towards what it is
above the column, and a meniscus stands at either end of it, as a bright bar across the bore.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .profile import TipProfile

Mask = NDArray[np.bool_]

_FROM_TOP = (0.03, 6.0)
_FROM_END = (0.06, 9.0)
"""What is left out next to the meniscus and the orifice, tip lengths and px."""

_BRIGHT = 0.4
"""A column that is brighter than the empty tip by this much (log) guides light: its own
ripples are bars too, and only a dip is a break."""

_BAR_WEIGHT = 0.6
"""The highest of some fifty bars of noise is higher than the deepest of some fifty dips."""


def strongest_break(profile: TipProfile, top: float) -> float | None:
    """Signal over noise of the strongest break in a column that reaches from the orifice to ``top``
    (u); how strong one has to be is for the caller to say, against normal columns.

    ``None`` where the column is too short to have one.
    """
    u = profile.u
    length = max(profile.length, 1.0)
    start = top + max(_FROM_TOP[0], _FROM_TOP[1] / length)
    inside = (u > start) & (u < 1.0 - max(_FROM_END[0], _FROM_END[1] / length))
    if int(inside.sum()) < 12:
        return None
    step = _brightness_step(profile, top, inside)
    dips, bars = _by_brightness(profile, step, inside), _by_menisci(profile, inside)
    return dips if step > _BRIGHT else max(dips, bars)


def lit(profile: TipProfile, top: float) -> bool:
    """Whether a column that ends at ``top`` (u) guides light: it glows far above its empty tip."""
    return _brightness_step(profile, top, (profile.u > top + 0.04) & (profile.u < 0.92)) > _BRIGHT


def _brightness_step(profile: TipProfile, top: float, inside: Mask) -> float:
    """How much brighter (log) the column is than the empty tip above it."""
    above = (profile.u < top - 0.04) & (profile.u > top - 0.15)
    if not above.any() or not inside.any():
        return 0.0
    return float(np.median(profile.brightness[inside]) - np.median(profile.brightness[above]))


def _by_brightness(profile: TipProfile, step: float, inside: Mask) -> float:
    brightness, rows = profile.brightness.astype(np.float64), np.flatnonzero(inside)
    strongest = 0.0
    if abs(step) < 0.05:
        return strongest
    for width in _widths(profile):
        dip = -np.sign(step) * _against_flanks(brightness, width)
        noise = 1.48 * float(np.median(np.abs(dip[rows] - np.median(dip[rows])))) + 0.01
        # What the background does behind a clear tip is no break in the column.
        behind = np.abs(_against_flanks(profile.background.astype(np.float64), width))
        behind = np.max([np.roll(behind, shift) for shift in (-2, 0, 2)], axis=0)
        near = dip[rows] - 1.2 * behind[rows]
        depth = float(near.max() / abs(step))
        # A gap cannot be deeper than the tip is empty, and a ripple of a bright column is no
        # gap however quiet the column is.
        clear = float((near.max() - np.median(dip[rows])) / noise)
        strongest = max(strongest, clear * min(1.0, max(0.0, depth) / 0.4))
    return strongest


def _by_menisci(profile: TipProfile, inside: Mask) -> float:
    """Bars below the topmost one, where the column is not so bright that they mean nothing."""
    return _BAR_WEIGHT * float(profile.bar[inside].max())


def _widths(profile: TipProfile) -> tuple[int, ...]:
    """Rows of the gaps to look for: about 2 to 8 % of the tip."""
    rows = 1.0 / profile.pitch
    return tuple(sorted({max(2, round(rows * share)) for share in (0.017, 0.025, 0.035, 0.05)}))


def _against_flanks(signal: NDArray[np.float64], width: int, spare: int = 1) -> NDArray[np.float64]:
    """Mean of ``width`` rows less the mean of the rows on both sides of them."""
    flank = max(4, width)
    kernel = np.concatenate(
        [
            np.full(flank, -0.5 / flank),
            np.zeros(spare),
            np.full(width, 1.0 / width),
            np.zeros(spare),
            np.full(flank, -0.5 / flank),
        ]
    )
    before = len(kernel) // 2
    padded = np.pad(signal, (before, len(kernel) - 1 - before), mode="edge")
    return np.asarray(np.correlate(padded, kernel, mode="valid"))
