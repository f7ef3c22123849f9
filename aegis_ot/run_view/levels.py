"""Where a column of liquid ends in a frame, as the evidence of a verdict tells it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..vocabulary import KeyframeKind
from .wells import Axis, Box, Level, Point

_BEYOND = 1.8
"""Half length of a mark, as a multiple of half the box's width."""


def axis_of(box: Box) -> Axis:
    """Orifice and collar of an upright tip in a box."""
    x, y, w, h = box
    return (x + w / 2, y + h), (x + w / 2, y)


def expected_level(
    evidence: Mapping[str, Any],
    kind: KeyframeKind,
    volume_ul: float,
    axis: Axis | None,
    box: Box | None,
) -> Level:
    """What should be in the tip, µL; marked where it is known how high columns stand.

    A tip's geometry alone does not tell: on rendered p20 plates columns stand half as high.
    """
    share = evidence.get("expected_top", {}).get(kind.value)
    return Level(volume_ul, mark=_mark(axis, box, share))


def measured_level(
    evidence: Mapping[str, Any], kind: KeyframeKind, axis: Axis | None, box: Box | None
) -> Level | None:
    """What was measured in the tip; ``None`` where it could not be."""
    told = evidence.get("measured_ul", {}).get(kind.value)
    if not told:
        return None
    return Level(
        float(told["volume"]),
        float(told["uncertainty"] or 0.0),
        float(told["air"] or 0.0),
        _mark(axis, box, told.get("top")),
    )


def _mark(axis: Axis | None, box: Box | None, share: float | None) -> tuple[Point, Point] | None:
    return None if axis is None or box is None or share is None else mark_at(axis, box, share)


def mark_at(axis: Axis, box: Box, share: float) -> tuple[Point, Point] | None:
    """Ends of a line across the tip at a fraction of its length; ``None`` at the orifice."""
    if share <= 0:
        return None
    orifice, collar = np.array(axis[0]), np.array(axis[1])
    along = collar - orifice
    length = float(np.hypot(*along))
    if length < 1:
        return None
    across = np.array([along[1], -along[0]]) / length
    across = across if across[0] >= 0 else -across
    middle = orifice + share * along
    reach = _BEYOND * box[2] / 2
    left, right = middle - reach * across, middle + reach * across
    return (float(left[0]), float(left[1])), (float(right[0]), float(right[1]))
