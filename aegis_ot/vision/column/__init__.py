"""The liquid column in a tip, measured along the tip's axis in frame coordinates."""

from .axis import rectify
from .contrast import WetAndDry, Wetness
from .evidence import Dye, EmptyColour, combine, mean_dye
from .learning import learn_run, learn_tip
from .measure import (
    Reference,
    TipLook,
    ceiling,
    expected_top,
    look_at_tip,
    look_beside,
    measure_column,
    shapes_of,
)
from .pair import column_left
from .profile import TipProfile
from .strip import TipShape
from .trajectory import RunReference, Signs, TipModel, place, weigh

__all__ = [
    "Dye",
    "EmptyColour",
    "Reference",
    "RunReference",
    "Signs",
    "TipLook",
    "TipModel",
    "TipProfile",
    "TipShape",
    "WetAndDry",
    "Wetness",
    "ceiling",
    "column_left",
    "combine",
    "expected_top",
    "learn_run",
    "learn_tip",
    "look_at_tip",
    "look_beside",
    "mean_dye",
    "measure_column",
    "place",
    "rectify",
    "shapes_of",
    "weigh",
]
