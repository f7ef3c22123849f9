"""Well plates seen from above: where the wells are, and how their colour changed."""

from .finding import LEAST_PITCH_PX, FoundPlate, find_plate, other_kind
from .formats import FORMATS, PlateFormat
from .measuring import Change, PlateLight, change_between, plate_light

__all__ = [
    "FORMATS",
    "LEAST_PITCH_PX",
    "Change",
    "FoundPlate",
    "PlateFormat",
    "PlateLight",
    "change_between",
    "find_plate",
    "other_kind",
    "plate_light",
]
