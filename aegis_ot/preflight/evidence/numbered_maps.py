"""Plate maps by column or row: ``{"drug": [2, 3], "vehicle": [6]}``, ``NTC_ROWS = "GH"``.

Where a place names both, as ``plate[f"{row}{column}"]`` does, the crossing is meant.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from ...instrumentation import NameBinding, is_spot
from ...vocabulary import WellRef
from ..layouts import Deck, WrittenColumns
from ..rules import Common
from ..text import Numbered, SourceFacts, lexicon_of, origins, tokens
from ..trace import row_column
from .clues import Clue, Strength
from .levels import are_amounts, as_one_of_amounts, far_apart, is_number, names_amounts, number_in

Entry: TypeAlias = "tuple[str, tuple[int | str, ...], float | None]"
"""What is said, of which columns or rows, and their level."""

_COUNTING = frozenset({"range", "len", "enumerate"})
_LETTERS = "ABCDEFGHIJKLMNOP"


def numbered_maps(
    deck: Deck, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Clue]:
    """Constants whose numbers or letters the run turns into columns or rows of its labware."""
    maps = _maps(names, facts)
    written = WrittenColumns(deck, facts, common)
    for name, listed in maps.items():
        value = _noted(facts, name, listed)
        counting = _counts(name, common)
        of_entry: dict[tuple[str, float | None], dict[WellRef, None]] = {}
        for place in facts.numbered:
            if _comes_from(facts, maps, place, name):
                for text, numbers, level in _entries(name, _column(facts, place, value), counting):
                    held = of_entry.setdefault((text, level), {})
                    meant = written.meant(place, text, numbers)
                    held.update(dict.fromkeys(_wells(deck, facts, maps, meant, numbers)))
        line = facts.assigned.get(name)
        amounts = far_apart([level for _, level in of_entry if level is not None])
        for (text, level), found in of_entry.items():
            wells = tuple(found)
            yield Clue(
                Strength.NAME,
                text,
                wells,
                line,
                f"plate map `{text}` at line {line}",
                levels=() if level is None else (level,) * len(wells),
            )
            drawn = tuple(ref for ref in wells if (ref.labware, ref.name) not in deck.received)
            if amounts and level is not None and drawn:
                where = f"`{name}` at line {line}"
                yield as_one_of_amounts(drawn, line, where, (level,) * len(drawn))


def _counts(name: str, common: Common) -> bool:
    """Whether the numbers of a map of this name are volumes or the like: not ``DOSE_OF_COLUMN``."""
    of_places = set(common.places)
    found = [m.phrase for m in lexicon_of({"count": common.countings}).find(name)]
    if of_places.issuperset(found):
        return bool(found) and not names_amounts(name, common)
    return True


_LONGEST_NOTE = 4


def _noted(facts: SourceFacts, name: str, value: Any) -> Any:
    """A list whose comments say one thing of each item: beside it, or "10 uM, 1 uM, vehicle"."""
    line = facts.assigned.get(name, 0)
    note = facts.comments.get(line, facts.comments.get(line - 1, ""))
    parts = [part.strip() for part in note.split(",")]
    short = all(len(tokens(part)) <= _LONGEST_NOTE for part in parts)
    said = facts.item_notes.get(name) or (parts if short else [])
    if isinstance(value, (list, tuple)) and len(set(said)) == len(value) > 1 and all(said):
        return dict(zip(said, value, strict=True))
    return value


def _column(facts: SourceFacts, place: Numbered, value: Any) -> Any:
    """A map with that cell of each of its rows which the name of a place is unpacked from.

    Rows that are dicts give what they say beside the place's key: ``{"col": 2, "cond": "mock"}``.
    """
    key = place.key or _field(facts, place, value)
    if key and isinstance(value, (list, tuple)):
        rows = [row for row in value if isinstance(row, Mapping) and key in row]
        said = [[item for item in row.values() if _is_word(item)] for row in rows]
        if rows and all(len(texts) == 1 for texts in said):
            return [(texts[0], row[key]) for texts, row in zip(said, rows, strict=True)]
    if isinstance(value, Mapping) and all(_places_in(key) for key in value):
        return value  # by column or row itself: its items are what is there
    made_of = origins(facts, (place.name,), place.lines)
    at: dict[int, int] = {}
    for names in facts.unpacked:
        held = [name for name in names if name == place.name] or [n for n in names if n in made_of]
        if len(held) == 1:
            at[len(names)] = names.index(held[0])
    return _narrowed(value, at) if at else value


def _field(facts: SourceFacts, place: Numbered, value: Any) -> str:
    """The one field of a table's rows that a place takes its numbers from: ``zone.columns``."""
    rows = value if isinstance(value, (list, tuple)) else ()
    if not rows or not all(isinstance(row, Mapping) for row in rows):
        return ""
    names = origins(facts, (place.name,), place.lines)
    of_places = {key for row in rows for key, cell in row.items() if _places_in(cell)}
    found = of_places & names
    return found.pop() if len(found) == 1 else ""


def _is_word(item: Any) -> bool:
    return isinstance(item, str) and bool(item) and not is_spot(item)


def _narrowed(value: Any, at: Mapping[int, int]) -> Any:
    if isinstance(value, Mapping):
        return {key: _narrowed(item, at) for key, item in value.items()}
    if isinstance(value, list) and all(
        isinstance(item, (tuple, list)) and all(map(_places_in, item)) for item in value
    ):
        return [_narrowed(tuple(item), at) for item in value]
    if isinstance(value, tuple) and len(value) in at:
        return value[at[len(value)]]
    return value


def _maps(names: Sequence[NameBinding], facts: SourceFacts) -> dict[str, Any]:
    """What may be a map, by name: written down, or made in the run of other constants."""
    made = {
        binding.name: dict(binding.numbers) or binding.values
        for binding in names
        if binding.name in facts.assigned and (binding.numbers or binding.values)
    }
    return {**made, **facts.records, **facts.constants}


def _entries(name: str, value: Any, counts: bool) -> Iterator[Entry]:
    """What a map says of its columns or rows; where it ``counts``, its numbers are no levels."""
    if isinstance(value, Mapping):
        for key, item in value.items():
            item = _one_word(item)
            if isinstance(key, (int, str)) and _places_in(key) and _is_said(item):
                if isinstance(item, str):
                    yield item, _places_in(key), None
                elif not counts and (isinstance(key, str) or _are_amounts(value)):
                    yield name, _places_in(key), float(item)
            elif isinstance(item, Mapping):
                # Beside a tube of its own, a column is where a row goes, not what the map lists.
                tubes = any(is_spot(cell) for cell in item.values())
                yield from _entries(str(key) if tubes else f"{name} {key}", item, counts)
            elif isinstance(key, str) and _places_in(item):
                yield f"{name} {key}", _places_in(item), number_in(key)
            elif is_number(key) and isinstance(item, (list, tuple)) and _places_in(item):
                yield name, _places_in(item), float(key)
    elif _places_in(value):
        yield name, _places_in(value), None
    elif isinstance(value, (list, tuple)):
        for row in value:
            cells = row if isinstance(row, (list, tuple)) else ()
            said = [cell for cell in cells if _is_word(cell)]
            places = [found for cell in cells if cell not in said and (found := _places_in(cell))]
            if len(places) == len(said) == 1:
                yield said[0], places[0], None


def _one_word(item: Any) -> Any:
    """The one word of a row, ``("vehicle", "A1", None)``; what else stands in a map as it is."""
    cells = item if isinstance(item, tuple) else ()
    said = [cell for cell in cells if _is_word(cell) and not _places_in(cell)]
    return said[0] if len(said) == 1 else item


def _are_amounts(value: Mapping[Any, Any]) -> bool:
    """Whether the numbers in a map from column to number are no columns themselves."""
    return are_amounts([float(item) for item in value.values() if is_number(item)])


def _is_said(item: Any) -> bool:
    """Whether this stands beside a column or a row and says what is there, or how much."""
    return is_number(item) or (isinstance(item, str) and not _places_in(item))


def _places_in(value: Any) -> tuple[int | str, ...]:
    """The numbers of columns, or the letters of rows, that a value is or lists."""
    listed = value if isinstance(value, (list, tuple)) else [value]
    if isinstance(value, str) and len(value) > 1 and not value.isdecimal():
        listed = list(value)
    listed = [int(item) if isinstance(item, str) and item.isdecimal() else item for item in listed]
    if listed and all(isinstance(item, int) and not isinstance(item, bool) for item in listed):
        return tuple(listed)
    if listed and all(isinstance(i, str) and len(i) == 1 and i in _LETTERS for i in listed):
        return tuple(listed)
    return ()


def _comes_from(facts: SourceFacts, maps: Mapping[str, Any], place: Numbered, name: str) -> bool:
    if place.name == name:
        return True
    if isinstance(maps[name], int):
        return False  # a number further away rather counts the turns than the columns
    from_names = origins(facts, (place.name,), place.lines)
    if name not in from_names:
        return False
    # Counting to make a map says columns: range(10, 12). Counting beside it does not.
    within = {
        other for made in from_names & maps.keys() for other, _, _ in facts.comes_from.get(made, ())
    }
    return (_COUNTING & from_names) <= within


def _wells(
    deck: Deck,
    facts: SourceFacts,
    maps: Mapping[str, Any],
    place: Numbered,
    numbers: tuple[int | str, ...],
) -> Iterator[WellRef]:
    """The wells that the run fills in these columns or rows, or else those that it uses."""
    wanted = set(_indices(numbers, place.first if place.axis == "column" else None))
    at = 1 if place.axis == "column" else 0
    across = _across(facts, maps, place)
    for key in sorted(deck.by_name.get(place.labware, ())):
        named = [
            name
            for name in deck.trace.labware[key].wells
            if row_column(name)[at] in wanted and (not across or row_column(name)[1 - at] in across)
        ]
        used = [deck.refs[key, name] for name in named if (key, name) in deck.refs]
        if place.axis == "row" and not across:
            # The row may hold other things in columns of which this place does not speak.
            here = deck.used_at(place.lines[0])
            used = [ref for ref in used if ref in here] or used
        yield from [ref for ref in used if (key, ref.name) in deck.received] or used
        if place.fixed is None and not _takes_less(facts, place):
            yield from (deck.ref(key, name) for name in deck.passed_over(key, named, at))


def _takes_less(facts: SourceFacts, place: Numbered) -> bool:
    """Whether some of these wells are left out on purpose: of other columns all are taken."""
    return place.partly and not all(
        other.partly
        for other in facts.numbered
        if (other.labware, other.axis) == (place.labware, place.axis)
    )


def _indices(places: Iterable[int | str], first: int | None) -> Iterator[int]:
    """Counted from 0; columns whose numbers begin with ``first``, or letters of rows."""
    for place in places:
        if isinstance(place, str):
            yield _LETTERS.index(place)
        elif first is not None:
            yield place - first


def _across(facts: SourceFacts, maps: Mapping[str, Any], place: Numbered) -> frozenset[int]:
    """The rows of a column's wells, or the columns of a row's; empty where that is not plain."""
    if place.fixed is not None:
        return frozenset({place.fixed})
    names = origins(facts, (place.across,), place.lines) if place.across else frozenset()
    if not _COUNTING.isdisjoint(names):
        return frozenset()
    listed = [maps[name] for name in names if name in maps]
    for loop in facts.runs:
        if any(loop.first <= line <= loop.last for line in place.lines):
            listed += [v.column for v in loop.values if v.name in names and v.column is not None]
    listed += [part for value in listed if isinstance(value, Mapping) for part in value.values()]
    listed += [tuple(value) for value in listed if isinstance(value, Mapping)]
    first = place.across_first if place.axis == "row" else None
    return frozenset(i for value in listed for i in _indices(_places_in(value), first))
