"""Well plates seen from above: where the wells are, and how their colour changed."""

from .finding import LEAST_PITCH_PX, FoundPlate, find_plate
from .formats import FORMATS, PlateFormat
from .measuring import Change, change_between

__all__ = [
    "FORMATS",
    "LEAST_PITCH_PX",
    "Change",
    "FoundPlate",
    "PlateFormat",
    "change_between",
    "find_plate",
]
