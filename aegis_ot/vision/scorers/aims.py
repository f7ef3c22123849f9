"""A trajectory as it reads where the tip's end is put a pixel higher or lower.

The detector is off by a pixel or two (``docs/explanation/detector.md``), and what is measured along
the tip moves with it. The mean of three readings moves less than one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ...vocabulary import KeyframeKind
from ..column import TipLook
from ..types import TrajectorySample
from .looks import looks_beside

AIMS: tuple[float, ...] = (0.0, -1.0, 1.0)
"""Where the tip's end is put, px along the tip beyond where it was seen."""


def aimed(sample: TrajectorySample, px: float) -> TrajectorySample:
    """The trajectory as it reads with all tips' ends so moved; the same for as long as it lives.

    Args:
        sample: As it was detected.
        px: How far, px; 0 gives the sample itself.
    """
    if not px:
        return sample
    return sample.once(f"aimed {px}", lambda: _with(sample, looks_beside(sample, px)))


def _with(sample: TrajectorySample, looks: Mapping[KeyframeKind, TipLook]) -> TrajectorySample:
    moved = replace(sample)
    # What every scorer asks for first: so it need not know.
    moved.once("looks", lambda: looks)
    return moved
