"""A run as a person reads it: plates, wells, frames with what was measured. Nothing is judged.

The sidecar's page, the report of a run and ``aegis-ot inspect`` show what is gathered here. It
starts from the overview of a run (``GET /v1/runs/{run}``) as plain values.
"""

from .plates import PlateCell, PlateMap, plate_maps
from .seen import seen_well, state_of
from .situation import Situation, doing, situations
from .summary import run_account
from .wells import Axis, Box, Inspection, Level, Picture, Point, SeenFrame, SeenWell

__all__ = [
    "Axis",
    "Box",
    "Inspection",
    "Level",
    "Picture",
    "PlateCell",
    "PlateMap",
    "Point",
    "SeenFrame",
    "SeenWell",
    "Situation",
    "doing",
    "plate_maps",
    "run_account",
    "seen_well",
    "situations",
    "state_of",
]
