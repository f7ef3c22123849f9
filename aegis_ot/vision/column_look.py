"""What is kept of one frame to read its column: the signals, and where the bore is how wide."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..vocabulary import KeyframeKind
from .column import TipProfile
from .tips import TipGeometry
from .types import Axis

_ORIFICE = (0.06, 8.0)
"""What is left out next to the orifice, tip lengths and px: its rim glints, and a drop hangs."""


@dataclass(frozen=True)
class Look:
    """Signals of one frame.

    Attributes:
        profile: Of the tip.
        tip: Its geometry.
        light: Median brightness of the whole frame: the pipette covers little of it.
        axis: Both ends of the tip in the frame, px; ``None`` where they are not known.
    """

    profile: TipProfile
    tip: TipGeometry
    light: float = 0.0
    axis: Axis | None = None

    @property
    def lowest(self) -> float:
        """Down to where a column can be told from the orifice's own glints, u."""
        return 1.0 - max(_ORIFICE[0], _ORIFICE[1] / max(self.profile.length, 1.0))

    def bore_px(self, top: float, bottom: float) -> float:
        """Mean width of the bore between two places (u) on the tip, px."""
        heights = (1.0 - np.linspace(top, bottom, 12)) * self.tip.length_mm
        width = 2.0 * float(np.mean(self.tip.inner_radius(heights)))
        return width * self.profile.length / self.tip.length_mm

    @property
    def bores(self) -> NDArray[np.float64]:
        """Width of the bore in each row, px."""
        heights = (1.0 - self.profile.u.astype(np.float64)) * self.tip.length_mm
        px_per_mm = self.profile.length / self.tip.length_mm
        return np.asarray(2.0 * self.tip.inner_radius(heights) * px_per_mm, dtype=np.float64)


Looks = Mapping[KeyframeKind, Look]
"""What is kept of the frames of one trajectory in which a tip was found."""
