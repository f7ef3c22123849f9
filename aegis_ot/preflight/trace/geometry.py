"""How much liquid stands below a height in a well, by the well's real shape.

The inner geometry of the labware definition, where it has one: sections, stacked from the bottom
up (Opentrons labware schema 2 and 3). Else a cylinder or cuboid under the mouth, above a cone or a
half ball where the bottom is a V or a U.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ...instrumentation import WellInfo

OVER_NOMINAL = 1.1
"""Brim volume by nominal volume where no geometry tells (``spec/rules.md``)."""


class Geometry:
    """The inside of one kind of well.

    Args:
        info: What the labware definition says.

    Attributes:
        depth: From the rim to the bottom, mm.
        brim: µL that it holds filled to the rim.
    """

    def __init__(self, info: WellInfo) -> None:
        self.depth = info.depth
        self._sections = info.sections or _assumed(info)
        self._known: dict[float, float] = {}
        self._scale = 1.0
        inside = self._reckon(info.depth)
        if info.sections:
            self.brim = max(inside, info.max_volume)
        else:
            self.brim = (info.max_volume or inside) * OVER_NOMINAL
            if 0 < inside < info.max_volume:
                self._scale = info.max_volume / inside  # narrower than what it is said to hold

    def volume_below(self, height: float) -> float:
        """µL that stand in the well when it is filled up to ``height`` mm above its bottom."""
        height = min(round(height, 2), self.depth)
        volume = self._known.get(height)
        if volume is None:
            volume = self._known[height] = self._reckon(height)
        return volume

    def _reckon(self, height: float) -> float:
        return self._scale * sum(_filled(section, height) for section in self._sections)


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

    A V is as high as makes the well hold its nominal volume, a U as high as a half ball.
    """
    depth = info.depth
    area = (
        math.pi / 4 * info.diameter**2 if info.diameter else (info.x_size or 0) * (info.y_size or 0)
    )
    width = info.diameter or min(info.x_size or 0, info.y_size or 0)
    tip = 0.0
    if info.bottom == "v" and area > 0:
        tip = min(max((depth - info.max_volume / area) * 1.5, width / 2), depth)
    elif info.bottom == "u":
        tip = min(width / 2, depth)
    if info.diameter:
        mouth = {"bottomDiameter": info.diameter, "topDiameter": info.diameter}
        ends = {"shape": "conical", "bottomDiameter": 0.0, "topDiameter": info.diameter}
        body = {"shape": "conical", **mouth}
    else:
        x, y = info.x_size or 0.0, info.y_size or 0.0
        sides = {"topXDimension": x, "topYDimension": y}
        ends = {"shape": "cuboidal", **sides, "bottomXDimension": 0.0, "bottomYDimension": y}
        body = {"shape": "cuboidal", **sides, "bottomXDimension": x, "bottomYDimension": y}
    if info.bottom == "u" and info.diameter:
        ends = {"shape": "spherical", "radiusOfCurvature": info.diameter / 2}
    return (
        {**ends, "bottomHeight": 0.0, "topHeight": tip},
        {**body, "bottomHeight": tip, "topHeight": depth},
    )
