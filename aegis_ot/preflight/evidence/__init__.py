"""All that speaks for the role of a well: names, plate maps, labels, liquids, texts and the run.

Door: :func:`gather` finds the clues. None of them says yet what its words mean; a family does, in
:mod:`aegis_ot.preflight.roles`.
"""

from .clues import Clue, Strength
from .gathering import gather
from .helpers import SAID_BY_FUNCTION
from .levels import are_one, levels_beside, levels_of, names_amounts, without_lone_middle
from .twins import may_be_twins

__all__ = [
    "SAID_BY_FUNCTION",
    "Clue",
    "Strength",
    "are_one",
    "gather",
    "levels_beside",
    "levels_of",
    "may_be_twins",
    "names_amounts",
    "without_lone_middle",
]
