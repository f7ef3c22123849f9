"""What the text of a protocol says: its comments, its constants, the words in its names."""

from .comments import comment_blocks, written_lines
from .facts import Loop, Numbered, Place, SourceFacts, Values
from .flow import EVERYWHERE, origins
from .legends import legend_of
from .levels import (
    UNITS,
    Concentration,
    Rank,
    amounts_in,
    comparable,
    concentration_in,
    concentrations_in,
    direction_in,
    level_in,
    listed_levels,
    name_without_level,
    numbers_in_order,
    unit_in,
    with_u,
    without_strength,
)
from .lines import source_lines
from .reading import read_source
from .word_lists import first_words, labware_words, words_of
from .words import Lexicon, Match, any_of, lexicon_of, tokens

__all__ = [
    "EVERYWHERE",
    "UNITS",
    "Concentration",
    "Lexicon",
    "Loop",
    "Match",
    "Numbered",
    "Place",
    "Rank",
    "SourceFacts",
    "Values",
    "amounts_in",
    "any_of",
    "comment_blocks",
    "comparable",
    "concentration_in",
    "concentrations_in",
    "direction_in",
    "first_words",
    "labware_words",
    "legend_of",
    "level_in",
    "lexicon_of",
    "listed_levels",
    "name_without_level",
    "numbers_in_order",
    "origins",
    "read_source",
    "source_lines",
    "tokens",
    "unit_in",
    "with_u",
    "without_strength",
    "words_of",
    "written_lines",
]
