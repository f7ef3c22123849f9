"""All that speaks for the role of a well: data and names, each with its kind and citation.

Names and data are the program's to read, prose is a model's (``docs/decisions``).
"""

from .deck import Deck
from .evidence import DOUBTFUL, Evidence, Kind
from .gathering import gather
from .labels import unknown_places
from .well_names import wells_in

__all__ = ["DOUBTFUL", "Deck", "Evidence", "Kind", "gather", "unknown_places", "wells_in"]
