"""Plate maps by column or row: ``{"drug": [2, 3], "vehicle": [6]}``, ``NTC_ROWS = "GH"``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, TypeAlias

from ...vocabulary import WellRef
from ..text import Numbered, SourceFacts, origins
from ..trace import row_column
from .clues import Clue, Strength
from .deck import Deck
from .levels import is_number

Entry: TypeAlias = "tuple[str, tuple[int | str, ...], float | None]"
"""What is said, of which columns or rows, and their level."""

_COUNTING = frozenset({"range", "len", "enumerate"})
_LETTERS = "ABCDEFGHIJKLMNOP"


def numbered_maps(deck: Deck, facts: SourceFacts) -> Iterator[Clue]:
    """Constants whose numbers or letters the run turns into columns or rows of its labware."""
    for name, value in facts.constants.items():
        entries = list(_entries(name, value))
        if not entries:
            continue
        places = [place for place in facts.numbered if _comes_from(facts, place, name, value)]
        if not places:
            continue
        line = facts.assigned.get(name)
        for text, numbers, level in entries:
            wells = tuple(
                dict.fromkeys(
                    ref for place in places for ref in _wells(deck, facts, place, numbers)
                )
            )
            yield Clue(
                Strength.NAME,
                text,
                wells,
                line,
                f"plate map `{text}` at line {line}",
                levels=() if level is None else (level,) * len(wells),
            )


def _entries(name: str, value: Any) -> Iterator[Entry]:
    if isinstance(value, Mapping):
        for key, item in value.items():
            if isinstance(key, str) and _places_in(item):
                yield f"{name} {key}", _places_in(item), None
            elif is_number(key) and isinstance(item, (list, tuple)) and _places_in(item):
                yield name, _places_in(item), float(key)
            elif isinstance(key, int) and isinstance(item, str):
                yield item, (key,), None
    elif _places_in(value):
        yield name, _places_in(value), None


def _places_in(value: Any) -> tuple[int | str, ...]:
    """The numbers of columns, or the letters of rows, that a value is or lists."""
    listed = value if isinstance(value, (list, tuple)) else [value]
    if isinstance(value, str) and len(value) > 1:
        listed = list(value)
    if listed and all(isinstance(item, int) and not isinstance(item, bool) for item in listed):
        return tuple(listed)
    if listed and all(isinstance(i, str) and len(i) == 1 and i in _LETTERS for i in listed):
        return tuple(listed)
    return ()


def _comes_from(facts: SourceFacts, place: Numbered, name: str, value: Any) -> bool:
    if place.name == name:
        return True
    if isinstance(value, int):
        return False  # a number further away rather counts the turns than the columns
    from_names = origins(facts, (place.name,), (place.line,))
    return name in from_names and _COUNTING.isdisjoint(from_names)


def _wells(
    deck: Deck, facts: SourceFacts, place: Numbered, numbers: tuple[int | str, ...]
) -> Iterator[WellRef]:
    """The wells that the run fills in these columns or rows, or else those that it uses."""
    wanted = {
        number - place.first if isinstance(number, int) else _LETTERS.index(number)
        for number in numbers
        if isinstance(number, int) or place.axis == "row"
    }
    rows = _rows(facts, place)
    at = 1 if place.axis == "column" else 0
    for key in sorted(deck.by_name.get(place.labware, ())):
        used = [
            ref
            for ref in deck.used_wells((key,))
            if row_column(ref.name)[at] in wanted and (not rows or ref.name[0] in rows)
        ]
        filled = [ref for ref in used if (key, ref.name) in deck.received]
        yield from filled or used


def _rows(facts: SourceFacts, place: Numbered) -> frozenset[str]:
    """Letters of the rows that a column's wells stand in; empty where that is not plain."""
    if len(place.rows) <= 1:
        return frozenset(place.rows)
    names = origins(facts, place.rows.split(), (place.line,))
    listed = [facts.constants[name] for name in names if name in facts.constants]
    for loop in facts.runs:
        if loop.first <= place.line <= loop.last:
            listed += [v.column for v in loop.values if v.name in names and v.column is not None]
    letters = [_places_in(value) for value in listed]
    return frozenset(str(x) for found in letters for x in found if isinstance(x, str))
