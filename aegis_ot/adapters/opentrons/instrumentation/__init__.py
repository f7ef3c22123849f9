"""Taps the instruments of one protocol run, so that others can listen. Robot side."""

from .labware import LabwareInfo, WellInfo
from .names import NameBinding, NameCollector
from .operation import Event, EventKind, Listener, Operation, OperationKind, PipetteInfo
from .repeating import is_repeatable
from .tap import Tap, tapped
from .tip_layers import expel
from .value_reader import PlateMapRow, is_spot
from .wells import wells_under

__all__ = [
    "Event",
    "EventKind",
    "LabwareInfo",
    "Listener",
    "NameBinding",
    "NameCollector",
    "Operation",
    "OperationKind",
    "PipetteInfo",
    "PlateMapRow",
    "Tap",
    "WellInfo",
    "expel",
    "is_repeatable",
    "is_spot",
    "tapped",
    "wells_under",
]
