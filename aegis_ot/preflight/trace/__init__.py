"""A recorded run, read as tips that meet wells, and liquids that move between them.

Door: :func:`build_trace` gives a :class:`Trace`.
"""

from .building import build_trace
from .chains import Transfer, chains_of, links_of
from .plates import Plates
from .replacements import Intervention, Replacements
from .shapes import SHAPES, shapes_of
from .table import places, trace_table
from .tips import Layer, Met, Tip, TipBox
from .trace import PlaceKey, Said, Trace
from .usage import Sides, Usage, in_trough, usage_of
from .visits import Imbalance, Visit
from .wells import Composition, Well, row_column

__all__ = [
    "SHAPES",
    "Composition",
    "Imbalance",
    "Intervention",
    "Layer",
    "Met",
    "PlaceKey",
    "Plates",
    "Replacements",
    "Said",
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
    "shapes_of",
    "trace_table",
    "usage_of",
]
