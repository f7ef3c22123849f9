"""A trajectory as it reads where the tip's end is put a pixel higher or lower.

The detector is off by a pixel or two (``docs/explanation/detector.md``), and what is measured along
the tip moves with it. The mean of three readings moves less than one.
"""

from __future__ import annotations

from dataclasses import replace

from ..crops import remember
from ..types import TrajectorySample
from .looks import looks_beside

AIMS = (0.0, -1.0, 1.0)
"""Where the tip's end is put, px along the tip beyond where it was seen."""


def aimed(sample: TrajectorySample, px: float) -> TrajectorySample:
    """The trajectory as it reads with all tips' ends so moved; the same for as long as it lives.

    Args:
        sample: As it was detected.
        px: How far, px; 0 gives the sample itself.
    """
    return remember(sample, f"aimed {px}", lambda seen: _aimed(seen, px)) if px else sample


def _aimed(sample: TrajectorySample, px: float) -> TrajectorySample:
    moved = replace(sample)
    # What every scorer asks for first: so it need not know.
    remember(moved, "looks", lambda _: looks_beside(sample, px))
    return moved
