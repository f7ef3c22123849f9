"""A run as a person reads it: plates, wells, frames with what was measured. Nothing is judged.

The sidecar's page, the report of a run and ``aegis-ot inspect`` show what is gathered here. It
starts from the overview of a run (``GET /v1/runs/{run}``) as plain values.
"""

from typing import TYPE_CHECKING

from ..lazy import door

if TYPE_CHECKING:
    from .answers import RECOVERY, Answer
    from .delivery_view import seen_well
    from .page_view import RunView, run_view
    from .plates import PlateView, WellView, count_wells, plates_of
    from .situation import Situation, doing, situations
    from .states import state_of
    from .summary import run_account
    from .wells import Axis, Box, Inspection, Level, Picture, Point, SeenFrame, SeenWell

__getattr__ = door(
    __name__,
    {
        "answers": "Answer RECOVERY",
        "page_view": "RunView run_view",
        "plates": "PlateView WellView count_wells plates_of",
        "delivery_view": "seen_well",
        "situation": "Situation doing situations",
        "states": "state_of",
        "summary": "run_account",
        "wells": "Axis Box Inspection Level Picture Point SeenFrame SeenWell",
    },
)

__all__ = [
    "RECOVERY",
    "Answer",
    "Axis",
    "Box",
    "Inspection",
    "Level",
    "Picture",
    "PlateView",
    "Point",
    "RunView",
    "SeenFrame",
    "SeenWell",
    "Situation",
    "WellView",
    "count_wells",
    "doing",
    "plates_of",
    "run_account",
    "run_view",
    "seen_well",
    "situations",
    "state_of",
]
