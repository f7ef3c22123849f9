"""The liquid column in a tip, measured along the tip's axis in frame coordinates."""

from .axis import nozzle_shift, rectify
from .contrast import Deliveries, WetAndDry, Wetness
from .evidence import DyeColour, EmptyColour, combine, mean_dye
from .learning import learn_run, learn_tip
from .measure import (
    Reference,
    TipLook,
    ceiling,
    expected_top,
    look_along,
    look_at_tip,
    read_column,
    shapes_of,
)
from .pair import at_one_place, held_still, shift_between
from .profile import TipProfile
from .strip import TipShape
from .trajectory import RunReference, Signs, TipModel, place, weigh

__all__ = [
    "Deliveries",
    "DyeColour",
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
    "at_one_place",
    "ceiling",
    "combine",
    "expected_top",
    "held_still",
    "learn_run",
    "learn_tip",
    "look_along",
    "look_at_tip",
    "mean_dye",
    "nozzle_shift",
    "place",
    "read_column",
    "rectify",
    "shapes_of",
    "shift_between",
    "weigh",
]
