"""A run as a person reads it: plates, wells, frames with what was measured. Nothing is judged.

The sidecar's page, the report of a run and ``aegis-ot inspect`` show what is gathered here. It
starts from the overview of a run (``GET /v1/runs/{run}``) as plain values.
"""

from typing import TYPE_CHECKING

from ..lazy import door

if TYPE_CHECKING:
    from .answers import RECOVERY
    from .delivery_view import seen_well
    from .page_view import RunView, run_view
    from .plates import PlateView, count_wells, plates_of
    from .states import state_of
    from .summary import run_account
    from .wells import Box, Inspection, Level, Picture, SeenWell

__getattr__ = door(
    __name__,
    {
        "answers": "RECOVERY",
        "page_view": "RunView run_view",
        "plates": "PlateView count_wells plates_of",
        "delivery_view": "seen_well",
        "states": "state_of",
        "summary": "run_account",
        "wells": "Box Inspection Level Picture SeenWell",
    },
)

__all__ = [
    "RECOVERY",
    "Box",
    "Inspection",
    "Level",
    "Picture",
    "PlateView",
    "RunView",
    "SeenWell",
    "count_wells",
    "plates_of",
    "run_account",
    "run_view",
    "seen_well",
    "state_of",
]
