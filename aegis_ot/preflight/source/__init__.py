"""What a protocol's text says as Python: tokens, comments, names, lines, how values flow."""

from typing import TYPE_CHECKING

from ...lazy import door

if TYPE_CHECKING:
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
    from .left_out import LeftOut, steps_left_out
    from .lexicon import Lexicon, Match, lexicon_of, tokens

# Who takes lines apart has no use for what reads concentrations.
__getattr__ = door(
    __name__,
    {
        "chance": "chances",
        "concentrations": "comparable level_in level_of name_without_level without_concentrations "
        "without_strength",
        "data_flow": "Index",
        "facts": "SourceFacts read_source source_lines",
        "left_out": "LeftOut steps_left_out",
        "lexicon": "Lexicon Match lexicon_of tokens",
    },
)  # fmt: skip

__all__ = [
    "Index", "LeftOut", "Lexicon", "Match", "SourceFacts", "chances", "comparable", "level_in",
    "level_of", "lexicon_of", "name_without_level", "read_source", "source_lines",
    "steps_left_out", "tokens", "without_concentrations", "without_strength",
]  # fmt: skip
