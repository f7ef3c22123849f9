"""How well each height of a tip would explain what is seen, as the top of a liquid column.

All functions give one number per row of a :class:`~.profile.TipProfile`: a log-likelihood ratio
between "a column reaches from the orifice up to this row" and "there is none". The ratios of
frames that show the same column add up, row by row, because every profile of a tip class has
the same rows. Each ratio is bounded: no single glint, and no single wrong assumption about a
dye, decides alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from .profile import TipProfile
from .strip import Array

IMPOSSIBLE = -50.0
"""Log-likelihood ratio of rows at which no column can end."""

_EDGE_EXPECTED = 2.2
_EDGE_RANGE = (-1.5, 8.0)
_COLOUR_LEAST = -12.0
_COLOUR_PLENTY = 30.0
_ANY_COLOUR = 0.05
_STEP_EXPECTED = 3.0
_STEP_RANGE = (-2.0, 8.0)


@dataclass(frozen=True)
class DyeColour:
    """The colour that a full column adds to a tip, as :attr:`TipProfile.colour` measures it.

    Attributes:
        red: Change of the red difference.
        blue: Change of the blue difference.
        sd: Standard deviation of either.
    """

    red: float
    blue: float
    sd: float

    @property
    def vector(self) -> Array:
        """``(2,)``, shrunk towards nothing as far as it may be noise."""
        raw = np.array([self.red, self.blue], dtype=np.float32)
        power = float(raw @ raw)
        kept = max(0.0, 1.0 - 2 * self.sd**2 / power) if power > 0 else 0.0
        return np.asarray(raw * kept, dtype=np.float32)


def mean_dye(dyes: list[DyeColour]) -> DyeColour | None:
    """Mean of several observations of one dye, weighted by their precision."""
    if not dyes:
        return None
    weights = np.array([1.0 / max(dye.sd, 1e-4) ** 2 for dye in dyes])
    total = float(weights.sum())
    red = float(weights @ np.array([dye.red for dye in dyes])) / total
    blue = float(weights @ np.array([dye.blue for dye in dyes])) / total
    return DyeColour(red, blue, float(1.0 / np.sqrt(total)))


@dataclass(frozen=True)
class SignalStep:
    """How much of a signal begins at a row and goes on to the orifice, for every row.

    Attributes:
        size: ``(rows,)`` at the row itself; below it, it dwindles as the bore does.
        sd: ``(rows,)`` its standard deviation, the rows' correlation counted; infinite where
            too few rows lie on one side.
    """

    size: Array
    sd: Array


_ABOVE = 0.25
"""How far up from a column's end its tip is compared with it, tip lengths: lamps and backgrounds
change along a tip."""

_TAPER_END = 1.03
"""Where the bore's width would reach nothing, u: a dye's colour, summed across the bore, falls off
towards it."""

_FEWEST_ROWS = 5
_ROW_NOISE = 2e-3
"""Least noise of a row: JPEG rounds faint colours to none, which proves nothing."""


def taper(u: Array) -> NDArray[np.float64]:
    """``(rows,)`` in what proportion the rows of one column show its colour; 1 at u = 0.5."""
    return np.maximum(_TAPER_END - u.astype(np.float64), 0.02) / (_TAPER_END - 0.5)


def long_step(u: Array, signal: Array, top: float, bottom: float) -> SignalStep:
    """Matched filter for a column that ends at each row between ``top`` and ``bottom`` (u).

    All rows below against those next above, each by how much colour a column would show there.
    """
    size = np.zeros(len(u), dtype=np.float32)
    sd = np.full(len(u), np.inf, dtype=np.float32)
    inside = np.flatnonzero((u > top) & (u < bottom))
    if len(inside) < 16:
        return SignalStep(size, sd)
    x = signal[inside].astype(np.float64)
    weight = taper(u[inside])
    n = len(x)
    k = np.arange(_FEWEST_ROWS, n - _FEWEST_ROWS + 1)
    reach = max(int(_ABOVE / float(u[1] - u[0])), 2 * _FEWEST_ROWS)
    rows_above = np.minimum(k, reach)
    # An empty tip has a tint of its own, which dwindles with the bore as well.
    matched, power = np.cumsum(weight * x), np.cumsum(weight**2)
    power_above = power[k - 1] - np.where(k > reach, power[k - 1 - rows_above], 0.0)
    above = matched[k - 1] - np.where(k > reach, matched[k - 1 - rows_above], 0.0)
    above = above / power_above
    power_below = power[-1] - power[k - 1]
    step = (matched[-1] - matched[k - 1]) / power_below - above
    best = int(np.argmax(np.abs(step) * np.sqrt(power_below)))
    rest = x - weight * (above[best] + np.where(np.arange(n) >= k[best], step[best], 0.0))
    noise = 1.48 * float(np.median(np.abs(rest - np.median(rest)))) + _ROW_NOISE
    spread = _correlation_length(np.clip(rest, -3 * noise, 3 * noise))
    size[inside[k]] = step
    sd[inside[k]] = noise * np.sqrt(spread * (1.0 / power_below + 1.0 / power_above))
    return SignalStep(size, sd)


def colour_steps(profile: TipProfile, top: float, bottom: float) -> tuple[SignalStep, SignalStep]:
    """Long steps of both colours, computed once per profile."""

    def make() -> tuple[SignalStep, SignalStep]:
        red, blue = (long_step(profile.u, profile.colour[:, i], top, bottom) for i in (0, 1))
        return red, blue

    return profile.once(("colour steps", top, bottom), make)


def _correlation_length(rest: Array) -> float:
    """Rows per independent sample: the integrated autocorrelation, at least 1."""
    rest = rest - rest.mean()
    power = float((rest * rest).mean()) + 1e-12
    total = 1.0
    for lag in range(1, min(40, len(rest) // 2)):
        share = float((rest[lag:] * rest[:-lag]).mean()) / power
        if share < 0.05:
            break
        total += 2 * share
    return total


@dataclass(frozen=True)
class EmptyColour:
    """The colour step that an empty tip shows of itself: its plastic, its light, what is behind.

    Attributes:
        red, blue: Usual step, lower part less upper part.
        red_sd, blue_sd: Standard deviation of it between frames and plates.
    """

    red: float = 0.0
    blue: float = 0.0
    red_sd: float = 0.008
    blue_sd: float = 0.008


Strengths = tuple[tuple[float, float], ...]

ELSEWHERE: Strengths = ((0.1, 0.05), (0.3, 0.15), (0.6, 0.3), (0.9, 0.35), (1.2, 0.15))
"""How strongly a full column's colour shows in a frame with another background, and how often."""

ALIKE: Strengths = ((0.5, 0.15), (0.8, 0.35), (1.0, 0.35), (1.3, 0.15))
"""The same for the keyframe in which the colour was learned."""


def colour_evidence(
    profile: TipProfile,
    dye: DyeColour | None,
    empty: EmptyColour,
    *,
    top: float,
    bottom: float = 0.97,
    strengths: Strengths = ELSEWHERE,
) -> Array:
    """Ratio from colour.

    Args:
        profile: The tip.
        dye: Colour of a full column; ``None`` if nothing is known of the reagent, then any
            colour counts, and much of it must be seen.
        empty: What an empty tip shows of itself.
        top: Where the free bore begins, u.
        bottom: Where the tip's end begins, u.
        strengths: How strongly the dye may show.
    """
    steps = colour_steps(profile, top, bottom)
    sizes = [
        step.size.astype(np.float64) - own
        for step, own in zip(steps, (empty.red, empty.blue), strict=True)
    ]
    variances = [
        step.sd.astype(np.float64) ** 2 + own**2
        for step, own in zip(steps, (empty.red_sd, empty.blue_sd), strict=True)
    ]
    if dye is None:
        ratio = np.zeros(len(profile.u))
        for size, variance in zip(sizes, variances, strict=True):
            wider = variance + _ANY_COLOUR**2
            ratio += 0.5 * size**2 * (1 / variance - 1 / wider)
            known = np.isfinite(variance)
            ratio[known] -= 0.5 * np.log(wider[known] / variance[known])
        return _bounded(ratio)
    vector = dye.vector
    power = sum(v**2 / w for v, w in zip(vector, variances, strict=True))
    if not np.any(power > 0):
        return np.zeros_like(profile.u)
    match = sum(v * s / w for v, s, w in zip(vector, sizes, variances, strict=True))
    # Beyond a power of 25 the noise is not what limits the match.
    soften = np.minimum(1.0, 25.0 / np.maximum(power, 1e-6))
    terms = [np.log(chance) + soften * a * (match - 0.5 * a * power) for a, chance in strengths]
    ratio = np.logaddexp.reduce(np.stack(terms), axis=0)
    return _bounded(ratio)


def _bounded(ratio: NDArray[np.float64]) -> Array:
    """Beyond plenty a ratio counts for a tenth: bounded in effect, but rows never tie."""
    over = np.maximum(ratio - _COLOUR_PLENTY, 0.0)
    kept = np.minimum(ratio, _COLOUR_PLENTY) + 0.1 * np.minimum(over, 400.0)
    return np.asarray(np.maximum(kept, _COLOUR_LEAST), dtype=np.float32)


def edge_evidence(profile: TipProfile, slack: int = 2) -> Array:
    """Ratio from the bright bar of a meniscus, found within ``slack`` rows."""
    near = cv2.dilate(profile.bar[:, None], np.ones((2 * slack + 1, 1), np.uint8))[:, 0]
    ratio = _EDGE_EXPECTED * (near - 0.5 * _EDGE_EXPECTED)
    return np.asarray(np.clip(ratio, *_EDGE_RANGE), dtype=np.float32)


def step_evidence(profile: TipProfile, reach: int = 8) -> Array:
    """Ratio from a step of brightness along the tip, either way, against ``reach`` rows."""
    size, noise = brightness_step(profile, reach)
    seen = np.abs(size) / noise
    ratio = _STEP_EXPECTED * (seen - 0.5 * _STEP_EXPECTED) / 2.0
    return np.asarray(np.clip(ratio, *_STEP_RANGE), dtype=np.float32)


def brightness_step(profile: TipProfile, reach: int = 8) -> tuple[Array, Array]:
    """Mean log brightness of the ``reach`` rows below each row minus that above, and its noise.

    What the background's own step lets through the tip counts as noise.
    """
    kernel = np.concatenate([np.full(reach, -1.0), [0.0], np.full(reach, 1.0)]) / reach
    kernel = kernel.astype(np.float32)[:, None]

    def step(rows: Array) -> Array:
        return np.asarray(
            cv2.filter2D(rows[:, None], cv2.CV_32F, kernel, borderType=cv2.BORDER_REPLICATE)[:, 0],
            dtype=np.float32,
        )

    size = step(profile.brightness)
    behind = cv2.dilate(np.abs(step(profile.background))[:, None], np.ones((5, 1), np.uint8))[:, 0]
    inside = (profile.u > 0.2) & (profile.u < 0.95)
    noise = 1.48 * float(np.median(np.abs(size[inside] - np.median(size[inside])))) + 0.01
    return size, np.hypot(noise, 0.7 * behind)


def combine(first: Array, second: Array, bonus: float = 10.0) -> Array:
    """Ratio of two frames that show the same column.

    Their sum, but never more than ``bonus`` above twice the weaker one: a glint in one frame
    alone is no column.
    """
    return np.minimum(first + second, bonus + 2 * np.minimum(first, second))
