"""All that speaks for the role of a well: data and names, each with its kind and citation.

Names and data are the program's to read, prose is a model's (``docs/decisions``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...adapters.opentrons.instrumentation import NameBinding
from ..rules import Common
from ..source import SourceFacts
from ..trace import Trace
from .deck import DeckNames
from .evidence import DOUBTFUL, Evidence, Kind
from .labels import given_roles, labels, loaded_liquids, unknown_places
from .names import fields_of_rows, named_wells
from .plate_maps import plate_maps
from .well_names import wells_in
from .written_wells import written_wells

__all__ = ["DOUBTFUL", "DeckNames", "Evidence", "Kind", "gather", "unknown_places", "wells_in"]


def gather(
    trace: Trace,
    names: Sequence[NameBinding],
    facts: SourceFacts,
    given: Mapping[str, Sequence[str]],
    common: Common,
) -> list[Evidence]:
    """All evidence of one protocol.

    The trace is a first reading of the run, to know labware, liquids and used wells; ``given`` are
    roles given outright: role to places (``"4:H12"``, ``"PCR plate:A1-A8"``).
    """
    deck = DeckNames(trace, names)
    found = [
        *given_roles(deck, given, common.levels),
        *loaded_liquids(deck),
        *named_wells(deck, names, facts, common),
        *fields_of_rows(names, facts),
        *plate_maps(deck, names, facts, common),
        *labels(deck),
        *written_wells(deck, facts),
    ]
    return list(dict.fromkeys(one for one in found if one.wells))
