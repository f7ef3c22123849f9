"""Wells written out in a comment or docstring: "PCR plate: A1-A3 standards, H12: NTC".

Read only where the whole block is of this kind, without remainder, and names its labware. All
else in prose is a model's to read. What is written helps to decide and never accuses alone.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from ...adapters.opentrons.instrumentation import LabwareInfo
from ...vocabulary import one_line
from ..source import SourceFacts
from .deck import DeckNames
from .evidence import LONGEST_QUOTE, Evidence, Kind
from .well_names import PLACES, wells_in

_WORD = r"(?!(?:in|is|are)\b|[A-P]\d)[\w%./+µ-]+"
_SAID = rf"(?=[^\W\d_]){_WORD}(?: {_WORD}){{0,3}}"
"""A few words: a name, no sentence."""
_BEFORE = re.compile(rf"({PLACES})\s*(?::|=|->|is\b|are\b|\s-\s)?\s*({_SAID})")
_BEHIND = re.compile(rf"({_SAID}?)\s*(?::|=|\bin\b|->|\()\s*({PLACES})\s*\)?")
_SEPARATOR = re.compile(r"\s*[,;\n.]\s*(?:and\s+)?|\s*$")
_HEAD = re.compile(r"\s*([^:\n]{2,60}?)\s*(?::|\n|\s[-–]\s)\s*")
_LONGEST = 2000
"""Longer texts are no lists of wells."""

Entry = tuple[list[str], str]
"""Names of wells, and what is said of them."""


def written_wells(deck: DeckNames, facts: SourceFacts) -> Iterator[Evidence]:
    """The blocks that read so, with what they say of each well."""
    for line, text in (*facts.comment_blocks(), *facts.docstrings):
        head = _HEAD.match(text) if len(text) <= _LONGEST else None
        called = deck.called(re.sub(r"^the\s+", "", head[1])) if head else []
        if head is None or len(called) != 1:
            continue
        info = deck.trace.labware[called[0]]
        for names, said in entries_of(text[head.end() :], info):
            citation = f"'{one_line(said, LONGEST_QUOTE)}' written at line {line}"
            yield Evidence(Kind.WRITTEN, said, deck.refs(info.key, names), citation)


def entries_of(text: str, info: LabwareInfo) -> list[Entry]:
    """The entries of a text that lists wells and what is in them; none if it says more."""
    return _entries(text.strip(), _BEFORE, 1, info) or _entries(text.strip(), _BEHIND, 2, info)


def _entries(text: str, pattern: re.Pattern[str], wells_at: int, info: LabwareInfo) -> list[Entry]:
    found: list[Entry] = []
    at = 0
    while at < len(text):
        match = pattern.match(text, at)
        names = wells_in(match[wells_at], info.wells) if match else []
        separator = _SEPARATOR.match(text, match.end()) if match else None
        if match is None or separator is None or not names:
            return []
        found.append((names, match[3 - wells_at].strip(" .")))
        at = separator.end()
    return found
