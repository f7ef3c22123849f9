"""A recorded run, read as tips that meet wells, and liquids that move between them.

Door: :func:`build_trace` gives a :class:`Trace`.
"""

from .building import build_trace
from .chains import Transfer, chains_of, links_of
from .geometry import Contact, Geometry
from .model import Composition, Layer, Met, Tip, Visit, Well
from .pauses import Intervention, Pauses
from .plates import Plates, row_column
from .table import places, trace_table
from .tip_racks import TipBox
from .trace import Imbalance, PlaceKey, Trace
from .usage import Sides, Usage, in_trough, usage_of

__all__ = [
    "Composition",
    "Contact",
    "Geometry",
    "Imbalance",
    "Intervention",
    "Layer",
    "Met",
    "Pauses",
    "PlaceKey",
    "Plates",
    "Sides",
    "Tip",
    "TipBox",
    "Trace",
    "Transfer",
    "Usage",
    "Visit",
    "Well",
    "build_trace",
    "chains_of",
    "in_trough",
    "links_of",
    "places",
    "row_column",
    "trace_table",
    "usage_of",
]
