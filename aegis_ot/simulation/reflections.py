"""The bright and dark lines on a tip: rims, glints, menisci, specks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..vision.tips import TipGeometry
from .scene import TipContent
from .session import SessionParameters

Plane = NDArray[np.float32]


@dataclass(frozen=True)
class TipPatch:
    """The patch of a frame that a tip covers.

    Attributes:
        across, along: mm right of the axis and above the orifice at each pixel, ``(h, w)``.
        mm_per_px: Size of a pixel in the tip's plane, mm.
        hidden_below: Height above the orifice below which labware hides the tip, mm.
        under: Colour of the labware under the tip, grey levels (B, G, R).
        beads: Random numbers for beads, fixed per tip and what it holds.
        wear: Random numbers for specks, fixed per tip: they tell nothing of what it holds.
    """

    across: Plane
    along: Plane
    mm_per_px: float
    hidden_below: float
    under: tuple[float, float, float]
    beads: np.random.Generator
    wear: np.random.Generator


def column_edges(tip: TipGeometry, content: TipContent) -> tuple[tuple[float, float], ...]:
    """The pieces of the column as ``(bottom, top)`` in mm above the orifice."""
    return tuple((tip.height_of(a), tip.height_of(b)) for a, b in content.slugs)


def meniscus_height(top: float, u: Plane, inner: Plane) -> Plane:
    """Height of a concave meniscus: liquid climbs the wall, volume kept."""
    ratio = np.clip(u / np.maximum(inner, 1e-3), 0, 1)
    return np.asarray(top + 0.35 * inner * (ratio**2 - 0.5), np.float32)


def edges(
    u: Plane, inner: Plane, outer: Plane, wet: Plane, view: TipPatch, p: SessionParameters
) -> Plane:
    """Bright rims: the outer silhouette, and the bore, which liquid nearly hides."""
    # The lines are thin: on a tip of a few pixels they fade instead of covering it.
    width = 0.07 * outer
    soft = np.maximum(view.mm_per_px * 0.6, width)
    fade = width / soft
    rim = np.exp(-(((outer - u) / soft) ** 2) / 2)
    bore = np.exp(-(((inner - u) / soft) ** 2) / 2)
    return np.asarray(p.rim * fade * (0.45 * rim + 0.38 * bore * (1 - 0.75 * wet)), np.float32)


def glints(view: TipPatch, inner: Plane, outer: Plane, wet: Plane, p: SessionParameters) -> Plane:
    """The lamp's image along the outside, and the one that a liquid column adds inside."""
    width = 0.08 * outer
    soft = np.maximum(width, view.mm_per_px * 0.5)
    outside = np.exp(-(((view.across - p.glint_side * outer) / soft) ** 2) / 2)
    caustic = np.exp(-(((view.across + 0.45 * p.glint_side * inner) / soft) ** 2) / 2)
    return np.asarray(p.glint * width / soft * (0.55 * outside + 0.28 * caustic * wet), np.float32)


def menisci(
    view: TipPatch, tip: TipGeometry, content: TipContent, inner: Plane, p: SessionParameters
) -> Plane:
    """A bright line over a dark one at each surface between liquid and air."""
    u = np.abs(view.across)
    lines = np.zeros_like(u)
    pieces = column_edges(tip, content)
    for i, (bottom, top) in enumerate(pieces):
        last = i == len(pieces) - 1
        ends = [top] if i == 0 else [bottom, top]
        for end in ends:
            # As the surface is spread by the view, its line is spread too, and fainter.
            spread = p.meniscus_edge if last and end == top else 0.35
            width = np.maximum(0.22 * inner * (0.5 + spread), 0.6 * view.mm_per_px)
            off = (view.along - meniscus_height(end, u, inner)) / width
            lines += 0.16 / (0.6 + spread) * (np.exp(-(off**2)) - 0.5 * np.exp(-((off - 1.5) ** 2)))
    return np.asarray(lines * (u < inner) * (0.4 + p.glint), np.float32)


def specks(view: TipPatch, tip: TipGeometry, p: SessionParameters) -> Plane:
    """Bright points anywhere in the tip, about a pixel in size."""
    total = np.zeros_like(view.across)
    if p.specks <= 0:
        return total
    for _ in range(int(view.wear.poisson(p.specks))):
        at = view.wear.uniform(0.0, tip.free_mm)
        side = view.wear.uniform(-0.9, 0.9) * float(tip.inner_radius(at))
        size = view.mm_per_px * view.wear.uniform(0.4, 0.9)
        away = ((view.along - at) ** 2 + (view.across - side) ** 2) / size**2
        total += np.float32(view.wear.uniform(0.2, 1.2)) * np.exp(-away / 2)
    return np.asarray(total, np.float32)
