"""What a protocol's text says as Python: tokens, comments, names, lines, how values flow."""

from .chance import chances
from .concentrations import (
    comparable,
    level_in,
    level_of,
    name_without_level,
    without_concentrations,
    without_strength,
)
from .data_flow import Index
from .facts import SourceFacts, read_source, source_lines
from .lexicon import Lexicon, Match, lexicon_of, tokens

__all__ = [
    "Index",
    "Lexicon",
    "Match",
    "SourceFacts",
    "chances",
    "comparable",
    "level_in",
    "level_of",
    "lexicon_of",
    "name_without_level",
    "read_source",
    "source_lines",
    "tokens",
    "without_concentrations",
    "without_strength",
]
