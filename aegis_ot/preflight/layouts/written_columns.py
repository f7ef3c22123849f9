"""Columns that the text of a protocol numbers from 1, as the plate does.

Where it says "column 1: vehicle" and the run takes ``VEHICLE_COLUMN = 1`` for an index, which
begins with 0, the layout tells which column is meant.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from ..rules import Common
from ..text import Numbered, SourceFacts, tokens, words_of, written_lines
from ..trace import row_column
from .clauses import parts_of
from .deck import Deck
from .well_names import well_names

_Said = tuple[frozenset[str], frozenset[int]]
"""The words of a part of the layout, and the columns of which it speaks, counted from 1."""


class WrittenColumns:
    """What the layouts of a text say of the columns of a labware."""

    def __init__(self, deck: Deck, facts: SourceFacts, common: Common) -> None:
        self._deck, self._facts, self._common = deck, facts, common
        self._names = well_names(common)
        self._said: dict[str, list[_Said]] = {}
        self._dull = words_of(tuple(word for kind in common.layout.values() for word in kind))

    def meant(self, place: Numbered, text: str, numbers: Sequence[int | str]) -> Numbered:
        """A place, counted from 1 where the layout says of these columns what ``text`` does."""
        keys = self._deck.by_name.get(place.labware, set())
        columns = frozenset(number for number in numbers if isinstance(number, int))
        if place.axis != "column" or place.first != 0 or len(keys) != 1 or not columns:
            return place
        (key,) = keys
        if key not in self._said:
            self._said[key] = list(self._read(key))
        words = frozenset(tokens(text)) - self._dull
        said = any(columns == listed and words & of for of, listed in self._said[key])
        return replace(place, first=1) if said else place

    def _read(self, key: str) -> Iterator[_Said]:
        """Nothing if no layout names the last column, which is no index counted from 0."""
        info = self._deck.trace.labware[key]
        found: list[_Said] = []
        for line in written_lines(self._facts):
            for part in parts_of(line, self._common):
                if part.wells and all(m["column"] or m["columns"] for m in part.wells):
                    columns = {
                        row_column(well)[1] + 1
                        for match in part.wells
                        for well in self._names.meant(match, info)
                    }
                    found.append((frozenset(tokens(part.words)), frozenset(columns)))
        last = max(row_column(well)[1] for well in info.wells) + 1
        return iter(found if any(last in columns for _, columns in found) else [])
