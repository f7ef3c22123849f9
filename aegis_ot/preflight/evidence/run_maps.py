"""Plate maps that only the run knows: read from a CSV text, or made of row letters and numbers."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ...instrumentation import NameBinding, Row, is_spot
from ...vocabulary import WellRef
from ..layouts import (
    Deck,
    drawn_and_filled,
    is_work_list,
    labware_by_field,
    labware_by_key,
    labware_in,
    labware_of_map,
    plain_name,
    refs_of,
    used_with,
)
from ..rules import Common
from ..text import SourceFacts, lexicon_of, origins, tokens
from .clues import Clue, Strength
from .levels import names_amounts, names_counts, number_in
from .name_parts import told_once, without_position
from .named_levels import numeric_keys


def spotted_names(
    deck: Deck, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Clue]:
    """Names that held well names in the run: ``CONTROLS = [f"{row}12" for row in "ABCD"]``."""
    loose = {name for _, name in facts.loose}
    keyed = numeric_keys(names)
    decks = lexicon_of({"deck": common.decks})
    shared = _shared_cells(names)
    for binding in names:
        base = binding.name.split("[", 1)[0]
        if not binding.spots or base in facts.constants or base in loose or decks.find(base):
            continue  # "A4" in a list of slots is none of a plate
        record, dot, field = base.partition(".")
        if dot and (binding.function, record) in facts.loops:
            continue  # the field of the last row only; see tabled_wells
        if dot and any((field, spot) in shared for spot in binding.spots):
            continue  # the field of another row as well
        standing = labware_by_field(deck, facts, record).get(field, ()) if dot else ()
        wells = tuple(refs_of(deck, standing, binding.spots)) or tuple(
            drawn_and_filled(deck, used_with(deck, facts, base), binding.spots)
        )
        if not wells:
            labware = labware_of_map(deck, facts, base, binding.spots, common)
            wells = tuple(refs_of(deck, labware, binding.spots))
        if wells:
            line = facts.assigned.get(base, binding.line)
            level = keyed.get(binding.name)
            yield Clue(
                Strength.NAME,
                without_position(told_once(binding.name), common),
                wells,
                line,
                f"plate map `{binding.name}` at line {line}",
                levels=() if level is None else (level,) * len(wells),
            )


def _shared_cells(names: Sequence[NameBinding]) -> set[tuple[str, Any]]:
    """Columns with a value that stands in several rows of one table."""
    counts = (Counter(cell for row in b.rows for cell in set(row.cells)) for b in names)
    return {cell for count in counts for cell, times in count.items() if times > 1}


def tabled_wells(
    deck: Deck, names: Sequence[NameBinding], facts: SourceFacts, common: Common
) -> Iterator[Clue]:
    """Rows that the run held: words and amounts beside wells, or beside names of wells."""
    parameters = {name for _, name in facts.loose}
    told = {binding.rows for binding in names if binding.name not in parameters}
    for binding in names:
        if binding.name in parameters and binding.rows in told:
            continue  # a helper's name for what has one of its own
        base = binding.name.split("[", 1)[0]
        written = facts.constants.get(base)
        if len(binding.rows) < 2 or (written is not None and not is_work_list(deck, written)):
            continue
        titles = _titles(facts, base)
        rows = [_titled(row, titles) for row in binding.rows]
        line = facts.assigned.get(base, binding.line)
        yield from clues_of_rows(deck, facts, common, rows, binding.name, line)


def clues_of_rows(
    deck: Deck,
    facts: SourceFacts,
    common: Common,
    rows: Sequence[Row],
    name: str,
    line: int | None,
) -> Iterator[Clue]:
    """What the rows of one table, called ``name``, say of the wells in them."""
    labware = labware_of_columns(deck, facts, rows, name)
    keyed = labware_by_key(deck, [row.cells for row in rows])
    titles = _noted_titles(facts, name, rows)
    beside: dict[tuple[str, str], Counter[WellRef]] = {}
    of_column: dict[str, Counter[WellRef]] = {}
    levels: dict[WellRef, float] = {}
    columns: dict[str, dict[WellRef, None]] = {}
    for row in rows:
        wells = list(row.wells)
        named = ""
        for column, cell in row.cells:
            named = keyed.get(column, {}).get(str(cell)) or labware_in(deck, cell) or named
            where = (named,) if named else labware.get(column, ())
            if where and (listed := spots_in(cell)):
                named = ""
                spots = list(refs_of(deck, where, listed))
                columns.setdefault(column, {}).update(dict.fromkeys(spots))
                wells += spots
        said = [(column, cell, number_in(cell)) for column, cell in row.said]
        for column, cell, number in said:
            of_column.setdefault(column, Counter()).update(wells)
            if isinstance(cell, str) and number is None and not spots_in(cell):
                beside.setdefault((column, cell), Counter()).update(wells)
        found = [
            number
            for column, _, number in said
            if number is not None
            and names_amounts(column, common)
            and not names_counts(column, common)
        ]
        if len(found) == 1:
            levels.update(dict.fromkeys(wells, found[0]))
    for column, held in columns.items():
        title = titles.get(column, column)
        if not title.isdecimal():
            evidence = f"column `{title}` of `{name}` at line {line}"
            yield Clue(Strength.NAME, title, tuple(held), line, evidence)
        yield Clue(
            Strength.LOOSE_NAME, name, tuple(held), line, f"`{name}` at line {line} lists it"
        )
    said_of: dict[str, dict[WellRef, None]] = {}
    for (column, text), times in beside.items():
        # Of a source beside other words in as many of its rows, a row like this says nothing.
        mostly = [
            ref
            for ref, count in times.items()
            if 2 * count > of_column[column][ref]
            or (2 * count == of_column[column][ref] and (ref.labware, ref.name) in deck.received)
        ]
        said_of.setdefault(text, {}).update(dict.fromkeys(mostly))
    for text, held in said_of.items():
        yield Clue(
            Strength.NAME,
            text,
            tuple(held),
            line,
            f"'{text}' beside it in `{name}` at line {line}",
            levels=tuple(levels.get(ref) for ref in held) if levels else (),
        )
    if levels:
        yield Clue(
            Strength.NAME,
            "",
            tuple(levels),
            line,
            f"numbers beside it in `{name}` at line {line}",
            levels=tuple(levels.values()),
        )


def spots_in(cell: Any) -> tuple[str, ...]:
    """The names of wells that a cell is or lists: ``"A1"``, ``"C4 C5"``."""
    words = re.split(r"[\s,;+/]+", cell.strip()) if isinstance(cell, str) else ()
    return tuple(map(plain_name, words)) if words and all(map(is_spot, words)) else ()


_LONGEST_TITLE = 3


def _noted_titles(facts: SourceFacts, name: str, rows: Sequence[Row]) -> dict[str, str]:
    """Titles that a comment on a table gives: "# (source slot, source well, destination)"."""
    note = facts.notes.get(name, "").strip(": ")
    told = [part.strip() for part in note.strip("()[]").split(",")]
    columns = [column for column, _ in rows[0].cells] if rows else []
    short = all(len(tokens(part)) <= _LONGEST_TITLE for part in told)
    listed = note.startswith(("(", "[")) or len(told) > 2
    if len(told) != len(columns) or not (short and listed and all(told)):
        return {}
    return dict(zip(columns, told, strict=True))


def _titles(facts: SourceFacts, name: str) -> dict[int, str]:
    """What the loops over some rows call the columns: ``for dest, src, kind in rows``."""
    return {
        values.at: values.name
        for loop in facts.runs
        for values in loop.values
        if values.source == name and values.at is not None
    }


def _titled(row: Row, titles: Mapping[int, str]) -> Row:
    """A row whose columns have names, or else their places."""
    return Row(
        tuple(
            (column or titles.get(at, str(at)), cell) for at, (column, cell) in enumerate(row.cells)
        )
    )


def labware_of_columns(
    deck: Deck, facts: SourceFacts, rows: Sequence[Row], name: str = ""
) -> dict[str, tuple[str, ...]]:
    """In which labware the well names of each column stand, where that is plain.

    It is the one that is indexed by that column's name, as taken from the table's rows if any is,
    or several of one kind; else, of the only such column, the one that is indexed by what the run
    takes from the table; else the only one in which the run uses all these wells, or most: those
    of "untreated" get nothing.
    """
    spots: dict[str, dict[str, None]] = {}
    for row in rows:
        for column, cell in row.cells:
            spots.setdefault(column, {}).update(dict.fromkeys(spots_in(cell)))
    found: dict[str, tuple[str, ...]] = {}
    placed = [column for column, listed in spots.items() if listed]
    of_table = used_with(deck, facts, name) if len(placed) == 1 else ()
    for column, listed in spots.items():
        if not listed:
            continue
        indexed: set[str] = set()
        places = [
            place
            for place in facts.places
            if column and (column in place.keys or column in place.names)
        ]
        own = [p for p in places if name and name in origins(facts, p.names, (p.line,))]
        for place in own or places:
            indexed |= deck.by_name.get(place.labware, set())
        if not indexed and len(of_table) == 1:
            indexed.update(of_table)
        if indexed and deck.are_alike(indexed):
            found[column] = tuple(sorted(indexed))
            continue
        used = {
            info.key: sum((info.key, spot) in deck.refs for spot in listed)
            for info in deck.plates()
        }
        wholly = [key for key, count in used.items() if count == len(listed)]
        using = wholly or [key for key, count in used.items() if 2 * count > len(listed)]
        if len(using) == 1:
            found[column] = (using[0],)
    return found
