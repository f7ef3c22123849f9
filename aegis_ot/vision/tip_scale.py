"""How high columns stand in a run's frames, against what the tip's geometry says.

The inside of a tip is not published (see :mod:`.tips`), and the camera looks at it at an angle.
Both change every height by the same factor in all wells of a run.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from .tips import TipGeometry

ENOUGH = 3
"""Columns of normal wells from which the run's own factor and spread are taken for real."""

NEAR = 0.04
"""A meniscus this close to its expected place is the expected one, tip lengths."""

_MEMORY = 32
_UNKNOWN_MM = 1.0
_LEAST_MM = 0.4
_UNKNOWN_SHARE = 0.12
"""What a volume is uncertain by before the run has shown its factor, as a fraction: some per cent
in height are two to three times that in the volume of a cone. On rendered plates, of which one
well was known, retained columns of dyes were read 9 to 27 % too small."""


class TipScale:
    """Column heights of one run's normal wells, found and wanted; shared by its liquids."""

    def __init__(self) -> None:
        self._heights: list[tuple[float, float]] = []
        self._earlier: dict[str, float] = {}

    def expect(self, factors: Mapping[str, float]) -> None:
        """Start from the factors that earlier runs showed, by the tip's name."""
        self._earlier = dict(factors)

    @property
    def known(self) -> bool:
        """Whether the run has shown its own factor and spread."""
        return len(self._heights) >= ENOUGH

    def note(self, tip: TipGeometry, top: float, volume_ul: float) -> None:
        """A normal column of a volume in µL ended at ``top`` (u: 0 collar, 1 orifice)."""
        wanted = max(float(tip.height_of(volume_ul)), 1.0)
        self._heights.append(((1.0 - top) * tip.length_mm, wanted))
        del self._heights[:-_MEMORY]

    def place(self, tip: TipGeometry, volume_ul: float) -> float:
        """Where a column of this volume should end, u; 1 without one."""
        if volume_ul <= 0:
            return 1.0
        return 1.0 - self._factor(tip) * float(tip.height_of(volume_ul)) / tip.length_mm

    def volume(self, tip: TipGeometry, top: float) -> float:
        """Volume of a column that ends at ``top`` (u), µL."""
        return float(tip.volume_of(self._height_mm(tip, top)))

    def sigma_ul(self, tip: TipGeometry, top: float, volume_ul: float) -> float:
        """Standard uncertainty of that volume, µL; ``volume_ul`` is the larger one at stake."""
        height = self._height_mm(tip, top)
        sigma = float(tip.volume_of(height + self._spread_mm(tip))) - float(tip.volume_of(height))
        return sigma if self.known else float(np.hypot(sigma, _UNKNOWN_SHARE * volume_ul))

    def margin(self, top: float) -> float:
        """How far from ``top`` (u) rows are surely on the side on which they should be."""
        return NEAR if self.known else 0.03 + 0.12 * (1.0 - top)

    def _height_mm(self, tip: TipGeometry, top: float) -> float:
        return max((1.0 - top) * tip.length_mm / self._factor(tip), 0.0)

    def _factor(self, tip: TipGeometry) -> float:
        ratios = [length / wanted for length, wanted in self._heights]
        return float(np.median(ratios)) if len(ratios) >= 2 else self._earlier.get(tip.name, 1.0)

    def _spread_mm(self, tip: TipGeometry) -> float:
        """How far the meniscus of normal wells stands from where it should, mm."""
        if not self.known:
            return _UNKNOWN_MM
        factor = self._factor(tip)
        residuals = np.array([length - factor * wanted for length, wanted in self._heights])
        return max(1.48 * float(np.median(np.abs(residuals - np.median(residuals)))), _LEAST_MM)
