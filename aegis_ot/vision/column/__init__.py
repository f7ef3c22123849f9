"""The liquid column in a tip, measured along the tip's axis in frame coordinates."""

from .breaks import Break
from .evidence import Dye, combine, mean_dye
from .measure import (
    ColumnMeasurement,
    Reference,
    expected_top,
    measure_column,
    read_column,
    shape_for,
    view_tip,
)
from .profile import TipProfile
from .strip import TipShape, rectify

__all__ = [
    "Break",
    "ColumnMeasurement",
    "Dye",
    "Reference",
    "TipProfile",
    "TipShape",
    "combine",
    "expected_top",
    "mean_dye",
    "measure_column",
    "read_column",
    "rectify",
    "shape_for",
    "view_tip",
]
