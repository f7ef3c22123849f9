"""The plates that there are: rows, columns, and where the wells stand on the footprint."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

LENGTH_MM, WIDTH_MM = 127.76, 85.48
"""Footprint of every plate (ANSI/SLAS 1), mm."""


@dataclass(frozen=True)
class PlateFormat:
    """A kind of plate. The grid is centred on the footprint.

    Attributes:
        rows, columns: Of wells.
        pitch_mm: From well to well. Fixed by ANSI/SLAS 4 for 96 and 384 wells, else a usual one:
            makers differ by a few per cent.
        radius_mm: Of a well at its top; of a square one half its side.
        square: Whether wells are square.
        depth_mm: Of a well.
    """

    rows: int
    columns: int
    pitch_mm: float
    radius_mm: float
    depth_mm: float
    square: bool = False

    @property
    def wells(self) -> int:
        return self.rows * self.columns

    @property
    def names(self) -> list[str]:
        """``"A1"``, ``"A2"``..., row by row."""
        return [
            f"{chr(ord('A') + row)}{column + 1}"
            for row in range(self.rows)
            for column in range(self.columns)
        ]

    def centres(self, margin: int = 0, shift: float = 0.0) -> NDArray[np.float64]:
        """Places of the grid, ``(n, 2)``, mm from the plate's middle, row by row from A1; y down.

        Args:
            margin: Rows and columns added all around.
            shift: Of all, pitches: 0.5 for the places between four wells.
        """
        down = np.arange(-margin, self.rows + margin) - (self.rows - 1) / 2 + shift
        along = np.arange(-margin, self.columns + margin) - (self.columns - 1) / 2 + shift
        x, y = np.meshgrid(along, down)
        return np.column_stack([x.ravel(), y.ravel()]) * self.pitch_mm


FORMATS: Mapping[int, PlateFormat] = MappingProxyType(
    {
        6: PlateFormat(2, 3, 39.12, 17.7, 17.4),
        12: PlateFormat(3, 4, 26.01, 11.3, 17.5),
        24: PlateFormat(4, 6, 19.3, 8.1, 17.4),
        48: PlateFormat(6, 8, 13.08, 5.6, 17.4),
        96: PlateFormat(8, 12, 9.0, 3.4, 10.7),
        384: PlateFormat(16, 24, 4.5, 1.8, 11.5, square=True),
    }
)
"""By number of wells."""
