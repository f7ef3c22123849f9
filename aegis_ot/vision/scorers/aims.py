"""A trajectory as it reads where the tip's end is put a pixel higher or lower.

The detector is off by a pixel or two (``docs/explanation/detector.md``), and what is measured along
the tip moves with it. The mean of three readings moves less than one.
"""

from __future__ import annotations

import math
from dataclasses import replace

from ..crops import remember
from ..types import TipDetection, TrajectorySample

AIMS = (0.0, -1.0, 1.0)
"""Where the tip's end is put, px along the tip beyond where the detector saw it."""


def aimed(sample: TrajectorySample, px: float) -> TrajectorySample:
    """The trajectory with all tips' ends moved along the tip; as long as ``sample`` lives the same.

    Args:
        sample: As it was detected.
        px: How far, px; 0 gives the sample itself.
    """
    if not px:
        return sample
    return remember(sample, f"aimed {px}", lambda seen: _moved(seen, px))


def _moved(sample: TrajectorySample, px: float) -> TrajectorySample:
    detections = {
        kind: None if tip is None else _longer(tip, px) for kind, tip in sample.detections.items()
    }
    return replace(sample, detections=detections)


def _longer(tip: TipDetection, px: float) -> TipDetection:
    x, y = tip.orifice
    length = math.hypot(x - tip.collar[0], y - tip.collar[1])
    if length <= abs(px):
        return tip
    right, down = (x - tip.collar[0]) / length * px, (y - tip.collar[1]) / length * px
    return replace(tip, orifice=(x + right, y + down), h=max(tip.h + down, 0.0))
