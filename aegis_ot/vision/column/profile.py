"""What each row of a straightened tip shows: brightness, colour, and edges across the bore.

Three physical signals, none of which needs the other:

- **Colour.** A dye absorbs, so the rows of a column differ in colour from the empty tip above
  it. Colour is the light that a row adds to what is beside the tip, summed across the bore: a
  difference of light, since the logarithm of a dark pixel is noise, and a sum, since blur and
  JPEG's chroma subsampling smear a bore of two pixels over six but lose nothing of it.
- **Edges.** A meniscus is a curved mirror: it shows as a thin bright bar across the whole bore,
  with any liquid. A speck (a caustic, a droplet outside) does not span the bore, so the bar is
  a trimmed mean across it.
- **Brightness.** Liquid guides or absorbs light; only steps of it along the tip are used.

Brightness is relative to the pipette's own nozzle inside the collar, which is white and lit as
the tip is: that cancels exposure and white balance.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, TypeVar, cast

import cv2
import numpy as np
from numpy.typing import NDArray

from .strip import Array, Strip, TipShape

T = TypeVar("T")

LANES = np.linspace(-2.6, 2.6, 53).astype(np.float32)
"""Positions across the axis at which rows are read, in outer radii of that row."""

_SECTION = np.linspace(-1.05, 1.05, 8)
INSIDE = np.abs(LANES) < 0.7
"""The lanes within the bore."""

_WIDE = np.abs(LANES) < 1.3
_BESIDE = np.abs(LANES) > 1.65
_DARK = 4.0
"""Grey levels added before a logarithm: dark pixels are noise."""

_THROUGH = 0.8
"""Share of the background's colour that shows through a tip."""

_FLOOR = 1e-3

SMEARED_PX = 3.0
"""Half the width over which blur and chroma subsampling spread the colour of a fine bore, px."""

_BESIDE_PX = (2.0, 6.0)
"""Where the background is taken, px outside of that."""

WHITE_LEAST = 8.0
"""Grey level of the nozzle below which a frame is too dark to tell its white."""


@dataclass(frozen=True)
class TipProfile:
    """Signals along one tip, one value per row; ``u`` runs from collar (0) to orifice (1).

    Attributes:
        u: ``(rows,)``.
        colour: ``(rows, 2)`` red less green and blue less green of the light that the row adds to
            what is beside the tip, as a mean over six pixels across, in units of the nozzle's.
        tint: ``(rows, 2)`` half the logarithm of red over green and of blue over green, less what
            the background explains of it: about the same in all rows of a column, so that rows of
            one run can be compared one by one, but noise where it is dark.
        brightness: ``(rows,)`` natural logarithm, relative to the nozzle.
        background: ``(rows,)`` the same beside the tip.
        bar: ``(rows,)`` a thin bright bar across the bore, in standard deviations of the rows
            of this tip.
        section: ``(rows, 7)`` brightness across the tip, from one wall to the other.
        length: Length of the tip in the frame, px.
        clarity: See :class:`~aegis_ot.vision.column.strip.Strip`.
    """

    u: Array
    colour: Array
    tint: Array
    brightness: Array
    background: Array
    bar: Array
    section: Array
    length: float
    clarity: float
    known: dict[object, Any] = field(default_factory=dict, repr=False, compare=False)
    """What was worked out of it before; see :meth:`once`."""

    def once(self, what: object, make: Callable[[], T]) -> T:
        """``make()``, computed once for this profile."""
        if what not in self.known:
            self.known[what] = make()
        return cast(T, self.known[what])

    @property
    def pitch(self) -> float:
        """Tip lengths per row."""
        return float(self.u[1] - self.u[0])


def tip_profile(strip: Strip, shape: TipShape, cone: Array | None = None) -> TipProfile:
    """Read the signals of a straightened tip (``cone``: what :func:`unroll` made of it)."""
    cone = unroll(strip, shape) if cone is None else cone
    u = strip.u
    nozzle = (u > 0.1 * shape.nozzle_end) & (u < 0.85 * shape.nozzle_end)
    white = np.median(cone[nozzle][:, INSIDE], axis=(0, 1))
    white = np.maximum(white, 4.0)
    luminance = np.log(np.maximum((cone / white).mean(axis=2), 0.02))
    brightness = np.median(luminance[:, INSIDE], axis=1)
    background = np.median(luminance[:, _BESIDE], axis=1)
    return TipProfile(
        u=u,
        colour=_colour(strip, shape, nozzle),
        tint=_tint(cone),
        brightness=brightness.astype(np.float32),
        background=background.astype(np.float32),
        bar=_bar(luminance, background, u),
        section=_section(luminance),
        length=strip.length,
        clarity=strip.clarity,
    )


def unroll(strip: Strip, shape: TipShape) -> Array:
    """Stretch each row so that the tip's outline becomes straight.

    Returns:
        ``(rows, lanes, 3)`` float32, BGR; lane positions are :data:`LANES`.
    """
    radius = shape.radius(strip.u)
    step = strip.u[1] - strip.u[0]
    x = LANES[None, :] * radius[:, None] / step + (len(strip.v) // 2)
    y = np.repeat(np.arange(len(strip.u), dtype=np.float32)[:, None], len(LANES), axis=1)
    return np.asarray(
        cv2.remap(
            strip.pixels,
            x.astype(np.float32),
            y,
            cv2.INTER_LINEAR,
            borderMode=cv2.BORDER_REPLICATE,
        ),
        dtype=np.float32,
    )


def _section(luminance: Array) -> Array:
    """Brightness across the tip in seven lanes: walls, core and the glints between them."""
    lanes = [
        luminance[:, (low <= LANES) & (high > LANES)].mean(axis=1)
        for low, high in pairwise(_SECTION)
    ]
    return np.asarray(np.stack(lanes, axis=1), dtype=np.float32)


def _colour(strip: Strip, shape: TipShape, nozzle: NDArray[np.bool_]) -> Array:
    """Light that the tip adds to what is beside it, summed across the bore; see the module."""
    # A camera's grey levels are about the square root of the light.
    light = np.square(np.maximum(strip.pixels, 0.0))
    inner = np.abs(strip.v) < 0.6 * shape.collar_radius
    white = np.median(light[nozzle][:, inner], axis=(0, 1))
    light = light / np.maximum(white, WHITE_LEAST**2)
    px = 1.0 / max(strip.length, 1.0)
    aside = np.abs(strip.v)[None, :]
    half = np.maximum(SMEARED_PX * px, 1.1 * shape.radius(strip.u))[:, None]
    near, far = (half + reach * px for reach in _BESIDE_PX)
    inside = (aside < half).astype(np.float32)
    beside = ((aside > near) & (aside < far)).astype(np.float32)
    beside /= np.maximum(beside.sum(axis=1, keepdims=True), 1.0)
    behind = np.einsum("rc,rck->rk", beside, light)
    added = np.einsum("rc,rck->rk", inside, light) - inside.sum(axis=1)[:, None] * behind
    added *= float(strip.v[1] - strip.v[0]) / px / (2 * SMEARED_PX)
    return np.stack([added[:, 2] - added[:, 1], added[:, 0] - added[:, 1]], axis=1)


def _tint(cone: Array) -> Array:
    """Colour of the tip against what is beside it, as absorbances against green's."""
    # Interpolation can undershoot black beside a bright edge.
    cone = np.maximum(cone, 0.0)
    inside = np.log(cone[:, _WIDE].mean(axis=1) + _DARK)
    beside = np.log(np.median(cone[:, _BESIDE], axis=1) + _DARK)
    seen = np.stack([inside[:, 2] - inside[:, 1], inside[:, 0] - inside[:, 1]], axis=1)
    behind = np.stack([beside[:, 2] - beside[:, 1], beside[:, 0] - beside[:, 1]], axis=1)
    return np.asarray(0.5 * (seen - _THROUGH * behind), dtype=np.float32)


def _bar(luminance: Array, background: Array, u: Array) -> Array:
    """Thin bright bars across the bore, standardised over the tip."""
    inner, wide = 3, 5
    surround = np.zeros(2 * (inner + wide) + 1, dtype=np.float32)
    surround[:wide] = surround[-wide:] = 0.5 / wide

    def peak(rows: Array) -> Array:
        smooth = cv2.GaussianBlur(rows, (1, 7), 0, sigmaY=1.2, borderType=cv2.BORDER_REPLICATE)
        around = cv2.filter2D(rows, cv2.CV_32F, surround[:, None], borderType=cv2.BORDER_REPLICATE)
        return np.asarray(smooth - around, dtype=np.float32)

    lanes = np.sort(peak(luminance[:, INSIDE].astype(np.float32)), axis=1)
    n = lanes.shape[1]
    cut = int(0.3 * n)
    bar = lanes[:, cut // 2 : n - cut].mean(axis=1)
    behind = peak(background[:, None].astype(np.float32))[:, 0]
    inside = (u > 0.2) & (u < 0.95)
    # The background shows through the tip: take out what follows it, and trust rows less
    # where it has an edge of its own.
    through = float((behind[inside] * bar[inside]).sum() / ((behind[inside] ** 2).sum() + 1e-6))
    rest = bar - np.clip(through, 0.0, 1.0) * behind
    rest = rest - np.median(rest[inside])
    noise = 1.48 * float(np.median(np.abs(rest[inside]))) + _FLOOR
    disturbed = cv2.dilate(np.abs(behind)[:, None], np.ones((7, 1), np.uint8))[:, 0]
    return np.asarray(rest / np.hypot(noise, 0.5 * disturbed), dtype=np.float32)
