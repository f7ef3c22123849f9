"""Geometry of pipette tips: where in the tip a given volume stands.

A tip is a stack of cones about its axis. Heights are mm along the axis above the orifice
(the lower end), radii are inner radii in mm, volumes are µL (1 mm³ = 1 µL).

Sources, and what is not known: length, overlap with the nozzle and nominal volume are those of
Opentrons' labware definitions (``opentrons_shared_data``, tip racks, schema 2). The inner
profile is *not* published. It is an approximation: a fine lower cone and a wider upper one,
chosen so that the tip holds a little more than its nominal volume below the nozzle and its
outside fits the hole of its rack. Expect errors of some per cent in column height, which is why
absolute volumes are calibrated in every run.

That of the OT-2's 200 and 300 µL tips is measured, on public photographs of an eight-channel p300
with red dye (github.com/mast13f/OT2-Computer-Vision, three series of twelve volumes). Their volumes
are not written down; steps of 10 and 20 µL from 30, 50 and 100 µL are the ones whose inner radii
agree with the outer ones in the pictures. Columns of the five other series are read 3 % too low so,
at the median (``python -m benchmarks.real_rows``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
_T = TypeVar("_T", float, Floats)


@dataclass(frozen=True)
class TipGeometry:
    """One kind of pipette tip.

    Attributes:
        name: ``"ot2_1000"``, ``"flex_50"``...
        nominal_ul: Working volume that its maker names, µL.
        length_mm: Orifice to collar, mm.
        overlap_mm: How deep the pipette's nozzle sits in it, mm.
        profile: ``(height, inner radius)`` pairs from orifice to collar, mm, heights rising.
        wall_mm: Wall thickness, mm.
        collar_mm: Height of the thickened ring at the upper end, mm.
        nozzle_radius_mm: Radius of the pipette's nozzle and shaft, mm.
    """

    name: str
    nominal_ul: float
    length_mm: float
    overlap_mm: float
    profile: tuple[tuple[float, float], ...]
    wall_mm: float = 0.4
    collar_mm: float = 6.0
    nozzle_radius_mm: float = 3.0
    _heights: Floats = field(init=False, repr=False, compare=False)
    _radii: Floats = field(init=False, repr=False, compare=False)
    _volumes: Floats = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        heights, radii = np.array(self.profile, dtype=float).T
        below = np.pi * np.diff(heights) / 3
        cones = below * (radii[:-1] ** 2 + radii[:-1] * radii[1:] + radii[1:] ** 2)
        object.__setattr__(self, "_heights", heights)
        object.__setattr__(self, "_radii", radii)
        object.__setattr__(self, "_volumes", np.concatenate(([0.0], np.cumsum(cones))))

    @property
    def free_mm(self) -> float:
        """Height of the nozzle's end above the orifice: liquid stands below it, mm."""
        return self.length_mm - self.overlap_mm

    @property
    def capacity_ul(self) -> float:
        """What fits between orifice and nozzle, µL."""
        return self.volume_of(self.free_mm)

    def inner_radius(self, height_mm: _T) -> _T:
        """Inner radius at a height, mm; the ends' radii outside the tip. Scalars or arrays."""
        return _like(height_mm, np.interp(height_mm, self._heights, self._radii))

    def outer_radius(self, height_mm: _T) -> _T:
        """Outer radius at a height, mm, the collar's ring left out. Scalars or arrays."""
        return _like(height_mm, np.interp(height_mm, self._heights, self._radii) + self.wall_mm)

    def volume_of(self, height_mm: _T) -> _T:
        """µL between the orifice and a height in mm (clipped to the tip). Scalars or arrays."""
        height = np.clip(height_mm, 0.0, self._heights[-1])
        i = np.clip(np.searchsorted(self._heights, height, "right") - 1, 0, len(self._radii) - 2)
        low = self._radii[i]
        up = height - self._heights[i]
        here = low + up * self._slope(i)
        volume = self._volumes[i] + np.pi * up / 3 * (low * low + low * here + here * here)
        return _like(height_mm, np.clip(volume, 0.0, self._volumes[-1]))

    def height_of(self, volume_ul: _T) -> _T:
        """Height in mm at which a column from the orifice ends (clipped to the tip).

        The inverse of :meth:`volume_of`, exact. Scalars or arrays.
        """
        volume = np.clip(volume_ul, 0.0, self._volumes[-1])
        i = np.clip(np.searchsorted(self._volumes, volume, "right") - 1, 0, len(self._radii) - 2)
        low, slope = self._radii[i], self._slope(i)
        rest = volume - self._volumes[i]
        flat = np.abs(slope) < 1e-9
        safe = np.where(flat, 1.0, slope)
        cone = (np.cbrt(low**3 + 3 * safe * rest / np.pi) - low) / safe
        up = np.where(flat, rest / (np.pi * low**2), cone)
        # The cube root of a cube is not its base on every processor, by a few parts in 10^16.
        up = np.where(rest > 0, up, 0.0)
        return _like(volume_ul, np.clip(self._heights[i] + up, 0.0, self._heights[-1]))

    def mm_per_ul(self, volume_ul: float) -> float:
        """How far the meniscus moves per µL at this volume, mm/µL."""
        return float(1.0 / (np.pi * self.inner_radius(self.height_of(volume_ul)) ** 2))

    def _slope(self, i: Any) -> Any:
        return (self._radii[i + 1] - self._radii[i]) / (self._heights[i + 1] - self._heights[i])


def _like(given: _T, result: Any) -> _T:
    """Give back a float for a scalar and an array for an array."""
    return cast(_T, float(result) if np.ndim(given) == 0 else result)


def _catalogue(*tips: TipGeometry) -> Mapping[str, TipGeometry]:
    return MappingProxyType({tip.name: tip for tip in tips})


_FINE = ((0.0, 0.22), (20.0, 0.50), (31.0, 1.12), (39.2, 1.30))
# Measured: see the module's description.
_MIDDLE = (
    *((0.0, 0.25), (9.0, 0.77), (16.0, 1.35), (30.0, 1.65)),
    *((44.0, 2.04), (51.8, 2.25), (59.3, 2.40)),
)

TIPS: Mapping[str, TipGeometry] = _catalogue(
    TipGeometry("ot2_10", 10, 39.2, 3.29, _FINE, 0.28, 4.0, 1.30),
    TipGeometry("ot2_20", 20, 39.2, 8.25, _FINE, 0.28, 4.0, 1.30),
    TipGeometry("ot2_200", 200, 59.3, 7.47, _MIDDLE, 0.32, 5.0, 2.35),
    TipGeometry("ot2_300", 300, 59.3, 7.47, _MIDDLE, 0.32, 5.0, 2.35),
    TipGeometry(
        "ot2_1000",
        1000,
        88.0,
        7.95,
        ((0.0, 0.40), (30.0, 1.60), (80.0, 3.25), (88.0, 3.30)),
        0.36,
        6.0,
        3.20,
    ),
    TipGeometry(
        "flex_20",
        20,
        52.0,
        10.5,
        ((0.0, 0.22), (22.0, 0.45), (34.0, 0.85), (41.5, 2.10), (52.0, 2.30)),
        0.40,
        6.0,
        2.25,
    ),
    TipGeometry(
        "flex_50",
        50,
        57.9,
        10.5,
        ((0.0, 0.25), (25.0, 0.60), (40.0, 1.00), (47.4, 2.10), (57.9, 2.30)),
        0.40,
        6.0,
        2.25,
    ),
    TipGeometry(
        "flex_200",
        200,
        58.35,
        10.5,
        ((0.0, 0.30), (20.0, 0.95), (47.85, 2.05), (58.35, 2.30)),
        0.40,
        6.0,
        2.20,
    ),
    TipGeometry(
        "flex_1000",
        1000,
        95.6,
        10.5,
        ((0.0, 0.40), (30.0, 1.90), (85.1, 2.70), (95.6, 2.75)),
        0.40,
        6.0,
        2.65,
    ),
)
"""Every tip known, by name."""


def pipette_class(pipette: str) -> str:
    """Short class of an Opentrons pipette name: ``"p1000_single_gen2"`` gives ``"p1000"``.

    ``"flex_1channel_1000"`` and ``"flex_96channel_1000"`` give ``"p1000"`` too. A name without
    a size comes back as it is.
    """
    name = pipette.lower()
    found = re.match(r"p(\d+)", name) or re.match(r"flex_.*?_(\d+)$", name)
    return f"p{found.group(1)}" if found else name


def is_flex(pipette: str) -> bool:
    """Whether an Opentrons pipette name is a Flex pipette's."""
    name = pipette.lower()
    return name.startswith("flex") or name.endswith("_flex") or name == "p1000_96"


def tip_for(pipette: str, capacity_ul: float | None = None) -> TipGeometry:
    """The tip that a pipette most likely carries.

    Args:
        pipette: Opentrons pipette name or short class (``"p20"``: OT-2).
        capacity_ul: Working volume of the tip, µL, if known (a keyframe says it). The nearest
            kind of that robot is taken; without it, the pipette's own size.

    An unknown pipette gets the tip nearest in volume, or a 300 µL one: geometry is a help to
    seeing, never a reason to fail.
    """
    size = re.sub(r"\D", "", pipette_class(pipette))
    wanted = capacity_ul or (float(size) if size else 300.0)
    # "p50_single" is an old OT-2 pipette on 300 µL tips; the bare class is the Flex one.
    flex = is_flex(pipette) or pipette.lower() == "p50"
    if not flex and size == "50":
        wanted = capacity_ul if capacity_ul and capacity_ul > 100 else 300.0
    family = [tip for tip in TIPS.values() if tip.name.startswith("flex") == flex]
    return min(family, key=lambda tip: abs(np.log(tip.nominal_ul / max(wanted, 1e-3))))
