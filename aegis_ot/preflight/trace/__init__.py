"""A recorded run, read as tips that meet wells, and liquids that move between them.

Door: :func:`build_trace` gives a :class:`Trace`.
"""

from .building import FALLS_MM, TO_EMPTY, build_trace
from .geometry import Contact, row_column
from .loads import Given, Load, loads_of
from .model import EMPTY_UL, Above, Met, Tip, Transfer, Visit, Well
from .pauses import topics_in
from .table import places, trace_table
from .tips import Retaking
from .trace import Beside, Imbalance, Trace, Usage, chains_of

__all__ = [
    "EMPTY_UL",
    "FALLS_MM",
    "TO_EMPTY",
    "Above",
    "Beside",
    "Contact",
    "Given",
    "Imbalance",
    "Load",
    "Met",
    "Retaking",
    "Tip",
    "Trace",
    "Transfer",
    "Usage",
    "Visit",
    "Well",
    "build_trace",
    "chains_of",
    "loads_of",
    "places",
    "row_column",
    "topics_in",
    "trace_table",
]
