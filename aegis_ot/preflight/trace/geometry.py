"""How much liquid stands below a height in a well, and whether a tip there meets it.

The inner geometry of the labware definition, where it has one: sections, stacked from the bottom
up (Opentrons labware schema 2 and 3). Else a cylinder or cuboid under the mouth, or a cone, or a
half ball below, as the shape of the bottom goes.
"""

from __future__ import annotations

import functools
import math
from bisect import bisect_right
from collections.abc import Mapping
from enum import IntEnum
from typing import Any

from ...adapters.opentrons.instrumentation import WellInfo

OVER_NOMINAL = 1.1
"""Brim volume by nominal volume, at least, where no geometry tells (``spec/rules.md``)."""

_OF_THE_SHAPE = 0.9
"""What a well holds, about, of the shape that its size and bottom give: flat and round bottoms, by
those of Opentrons' definitions whose inner geometry is known. V bottoms hold more."""

CLEARANCE_MM = 2.0
"""A tip end at least this far above the liquid does not touch it (``spec/rules.md``)."""

UPPER_PART = 2 / 3
"""A tip this share of a well's depth above its bottom is clear of a liquid of unknown volume."""

_TAPER = 0.45
"""Width at the bottom of a round V by that at its mouth, as in PCR plates of known geometry."""


class Contact(IntEnum):
    """How surely a tip met a well's liquid (``spec/rules.md``, Contact)."""

    CLEAR = 0
    UNSURE = 1
    """High over the bottom of a well that no more than a variable's name says to hold liquid."""
    NEAR = 2
    WET = 3


class Geometry:
    """The inside of one kind of well.

    Attributes:
        depth: From the rim to the bottom, mm.
        brim: µL that it holds filled to the rim.
        volume_below: µL that stand in the well when it is filled up to a height, mm above its
            bottom.
    """

    def __init__(self, info: WellInfo) -> None:
        self.depth = info.depth
        self._sections = info.sections or _assumed(info)
        self._scale = 1.0
        self.volume_below = functools.cache(self._volume_below)
        inside = self._reckoned(info.depth)
        if info.sections:
            self.brim = max(inside, info.max_volume)
        else:
            self.brim = max((info.max_volume or inside) * OVER_NOMINAL, inside * _OF_THE_SHAPE)
            if 0 < inside < info.max_volume:
                self._scale = info.max_volume / inside  # narrower than what it is said to hold

    def _volume_below(self, height: float) -> float:
        return self._scale * self._reckoned(min(round(height, 2), self.depth))

    def level_of(self, volume: float) -> float:
        """How high so many µL stand above the bottom, mm."""
        tenths = range(round(10 * self.depth))
        return bisect_right(tenths, volume, key=lambda at: self.volume_below(at / 10)) / 10

    def is_high(self, height: float) -> bool:
        """Whether a height above the bottom is in the upper third, where no liquid is expected."""
        return height >= UPPER_PART * self.depth

    def _reckoned(self, height: float) -> float:
        return sum(_filled(section, height) for section in self._sections)


def _filled(section: Mapping[str, Any], height: float) -> float:
    """µL in one section below a height; areas are at most quadratic, so Simpson's rule is exact."""
    bottom, top = float(section["bottomHeight"]), float(section["topHeight"])
    span = min(height, top) - bottom
    if span <= 0 or top <= bottom:
        return 0.0
    middle, end = (span * part / (top - bottom) for part in (0.5, 1.0))
    areas = (_area(section, 0.0) + 4 * _area(section, middle) + _area(section, end)) / 6
    return span * areas * int(section.get("xCount", 1)) * int(section.get("yCount", 1))


def _area(section: Mapping[str, Any], part: float) -> float:
    """Cross-section, mm², at a part (0 to 1) of a section's height."""
    shape = section["shape"]

    def between(low: str, high: str) -> float:
        return float(section[low]) + part * (float(section[high]) - float(section[low]))

    if shape == "conical":
        return math.pi / 4 * between("bottomDiameter", "topDiameter") ** 2
    if shape in ("cuboidal", "pyramidal"):
        return between("bottomXDimension", "topXDimension") * between(
            "bottomYDimension", "topYDimension"
        )
    if shape == "spherical":
        height = part * (float(section["topHeight"]) - float(section["bottomHeight"]))
        return math.pi * height * max(2 * float(section["radiusOfCurvature"]) - height, 0.0)
    # From a circle to a rectangle or back (squaredcone, roundedcuboid).
    circle = math.pi / 4 * float(section["circleDiameter"]) ** 2
    box = float(section["rectangleXDimension"]) * float(section["rectangleYDimension"])
    low, high = (circle, box) if section.get("bottomCrossSection") == "circular" else (box, circle)
    return low + part * (high - low)


def _assumed(info: WellInfo) -> tuple[Mapping[str, Any], ...]:
    """Sections for a definition without any: the mouth's shape down to the bottom's.

    A round V tapers all the way, as PCR wells and tubes do.
    """
    depth, width = info.depth, info.diameter or min(info.x_size or 0.0, info.y_size or 0.0)
    rounded = min(width / 2, depth) if info.bottom in ("u", "v") else 0.0
    if not info.diameter:
        sides = {"topXDimension": info.x_size, "topYDimension": info.y_size}
        box = {"shape": "cuboidal", **sides, "bottomYDimension": info.y_size}
        return (
            {**box, "bottomXDimension": 0.0, "bottomHeight": 0.0, "topHeight": rounded},
            {**box, "bottomXDimension": info.x_size, "bottomHeight": rounded, "topHeight": depth},
        )
    tube = {"shape": "conical", "bottomDiameter": width, "topDiameter": width, "topHeight": depth}
    if info.bottom == "v":
        return ({**tube, "bottomDiameter": width * _TAPER, "bottomHeight": 0.0},)
    ball = {"shape": "spherical", "radiusOfCurvature": width / 2, "bottomHeight": 0.0}
    return ({**ball, "topHeight": rounded}, {**tube, "bottomHeight": rounded})


@functools.lru_cache(maxsize=4096)
def row_column(name: str) -> tuple[int, int]:
    """``"B12"`` -> ``(1, 11)``; names that are not of this form count as the first well."""
    letters = name.rstrip("0123456789")
    digits = name[len(letters) :]
    row = 0
    for letter in letters.upper():
        if not "A" <= letter <= "Z":
            return (0, 0)
        row = row * 26 + ord(letter) - ord("A") + 1
    return (max(row - 1, 0), int(digits) - 1 if digits else 0)
