"""A tip and what it holds as the surfaces that light meets: plastic, liquid, air."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from aegis_ot.simulation.dyes import REFERENCE_PATH_MM, Dye
from aegis_ot.simulation.reflections import column_edges
from aegis_ot.simulation.scene import TipContent
from aegis_ot.vision.tips import TipGeometry

from .lathe import Surface, ball, turn

Floats = NDArray[np.float64]

GAMMA = 2.2
"""Between linear light and the grey levels in which the dyes' transmissions were measured."""
MENISCUS = 0.35
"""Depth of a concave meniscus, in inner radii."""
PIECES = 24
"""Stretches into which a wall is cut, so that its colour follows its width."""


@dataclass(frozen=True)
class TipSurfaces:
    """The surfaces of one tip, named by what lies inside and outside of their normals.

    Attributes:
        plastic: Plastic within, air without: the tip's outer side and its two rings.
        bore: Air within, plastic without: the dry inner wall.
        wet_bore: Liquid within, plastic without; coloured by the light that the dye leaves.
        liquid: Liquid within, air without: menisci, the lower end, a hanging drop (drawn clear).
        shaft: The pipette's nozzle, which is not transparent.
    """

    plastic: tuple[Surface, ...]
    bore: tuple[Surface, ...]
    wet_bore: tuple[Surface, ...]
    liquid: tuple[Surface, ...]
    shaft: Surface


@dataclass(frozen=True)
class Sleeve:
    """The wider upper part of a tip, as most makers' have it: on real ones a clear step.

    Attributes:
        share: Of the tip's length.
        step_mm: By how much its radius exceeds the wall's below it.
        flare_mm: By how much more at the rim.
        ribs: Along it; 0 for a smooth one.
        rib_mm: Their depth.
    """

    share: float = 0.3
    step_mm: float = 0.3
    flare_mm: float = 0.5
    ribs: int = 12
    rib_mm: float = 0.15

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Sleeve:
        return cls(
            share=float(rng.uniform(0.1, 0.4)),
            step_mm=float(rng.uniform(0.1, 0.5)),
            flare_mm=float(rng.uniform(0.0, 0.7)),
            ribs=int(rng.choice((0, 8, 12, 16))),
            rib_mm=float(rng.uniform(0.05, 0.2)),
        )


@dataclass(frozen=True)
class Liquid:
    """A dye at a strength: a multiple of the concentration at which it was measured."""

    dye: Dye
    strength: float = 1.0

    def left(self, path_mm: float) -> Floats:
        """Share of linear light (R, G, B) left after a path in it (Beer-Lambert)."""
        exponent = GAMMA * self.strength * path_mm / REFERENCE_PATH_MM
        return np.asarray(self.dye.transmission)[::-1] ** exponent


def tip_surfaces(
    tip: TipGeometry,
    content: TipContent,
    liquid: Liquid,
    shaft_mm: float,
    sleeve: Sleeve | None = None,
) -> TipSurfaces:
    """Cut a tip with its contents into surfaces, in mm above its orifice.

    Args:
        tip: Its geometry.
        content: What it holds.
        liquid: Its colour.
        shaft_mm: Length of shaft in view above the tip, mm.
        sleeve: Its upper part; without, it has a ring there.
    """
    free = tip.free_mm if content.present else tip.length_mm
    top = tip.length_mm + shaft_mm
    radius = tip.nozzle_radius_mm
    foot = float(tip.inner_radius(free)) - 0.02 if content.present else radius
    shaft = turn([(free, 1e-4), (free, foot), (tip.length_mm, radius), (top, radius)])
    if not content.present:
        return TipSurfaces((), (), (), (), shaft)
    slugs = column_edges(tip, content)
    dry, wet, ends = [], [], []
    at = 0.0
    for i, (low, high) in enumerate(slugs):
        above = slugs[i + 1][0] if i + 1 < len(slugs) else np.inf
        bottom = at if low == 0.0 else max(low - _climb(tip, low), at + 0.02)
        rim = min(high + _climb(tip, high), (high + above) / 2 - 0.01)
        if bottom > at:
            dry.append(_bore(tip, at, bottom))
        wet.append(_bore(tip, bottom, rim, liquid))
        ends += [_end(tip, bottom, -1.0 if low > 0.0 else 0.0), _end(tip, rim, 1.0)]
        at = rim
    dry.append(_bore(tip, at, tip.length_mm))
    if content.drop_ul > 0:
        size = float(np.cbrt(0.75 * content.drop_ul / np.pi))
        ends.append(ball(size, -0.92 * size))
    outside = _plastic(tip) if sleeve is None else _sleeved(tip, sleeve)
    return TipSurfaces((outside,), tuple(dry), tuple(wet), tuple(ends), shaft)


def _plastic(tip: TipGeometry) -> Surface:
    """Outer side with its collar, walked upwards from the orifice's rim to the upper rim."""
    ring = tip.length_mm - tip.collar_mm
    heights = np.unique([0.0, ring, *(h for h, _ in tip.profile if h < ring)])
    wall = [(float(h), float(tip.outer_radius(float(h)))) for h in heights]
    wide = 0.35 * tip.wall_mm
    collar = [(h, float(tip.outer_radius(h)) + wide) for h in (ring + 1e-3, tip.length_mm)]
    rim = (tip.length_mm, float(tip.inner_radius(tip.length_mm)))
    return turn([(0.0, float(tip.inner_radius(0.0))), *wall, *collar, rim])


def _sleeved(tip: TipGeometry, sleeve: Sleeve) -> Surface:
    """Outer side with a sleeve, walked upwards."""
    step, flare = (1 - sleeve.share) * tip.length_mm, 0.94 * tip.length_mm
    heights = np.unique([0.0, step, *(h for h, _ in tip.profile if h < step)])
    wall = [(float(h), float(tip.outer_radius(float(h)))) for h in heights]
    wide = wall[-1][1] + sleeve.step_mm
    depth = min(sleeve.rib_mm, 0.8 * sleeve.step_mm)
    inner = float(tip.inner_radius(tip.length_mm))
    neck = max(wide, inner + 0.3)
    bends = sorted({step + 1e-3, flare, *(h for h, _ in tip.profile if step < h < flare)})
    # The bore stays within: it may widen faster than the sleeve does.
    upper = [
        (h, max(float(np.interp(h, [step, flare], [wide, neck])),
                float(tip.inner_radius(h)) + depth + 0.1))
        for h in bends
    ]  # fmt: skip
    rim = neck + sleeve.flare_mm
    upper += [(tip.length_mm, rim), (tip.length_mm, inner)]
    return turn(
        [(0.0, float(tip.inner_radius(0.0))), *wall, *upper],
        flutes=(sleeve.ribs, depth, step + 5e-4),
    )


def _bore(tip: TipGeometry, low: float, high: float, liquid: Liquid | None = None) -> Surface:
    """Inner wall between two heights, the plastic on its outer side."""
    heights = np.linspace(low, high, PIECES)
    radii = tip.inner_radius(heights)
    colour = None
    if liquid is not None:
        # A ray crosses the wet wall twice; the mean chord of a circle is pi/2 of its radius.
        colour = np.stack([liquid.left(np.pi / 4 * float(r)) for r in radii])
    return turn([(float(h), float(r)) for h, r in zip(heights, radii, strict=True)], colour)


def _climb(tip: TipGeometry, height: float) -> float:
    """How far liquid climbs the wall above its mean level, mm; its volume is kept."""
    return 0.5 * MENISCUS * float(tip.inner_radius(height))


def _end(tip: TipGeometry, rim: float, upwards: float) -> Surface:
    """Where liquid meets air.

    ``upwards``: 1 for a column's upper meniscus, -1 for one that hangs on air below it, 0 for the
    flat end in the orifice.
    """
    radius = float(tip.inner_radius(rim))
    ratio = np.linspace(1e-3, 1.0, 9)
    sag = upwards * MENISCUS * radius * (ratio**2 - 1.0)
    cap = [(rim + float(c), radius * float(u)) for c, u in zip(sag, ratio, strict=True)]
    # Walked from the wall inwards the outside is above, and the other way it is below.
    return turn(cap[::-1] if upwards > 0 else cap)
