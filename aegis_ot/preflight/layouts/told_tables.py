"""Tells tables in plain lines: "slot 7: tube rack" and below it "A1 master mix", ...

A table says in columns of their own which slot is meant, what stands there, where in it, and what
that holds, each over several lines perhaps::

    | slot | labware              | content                    |
    |------|----------------------|----------------------------|
    | 7    | tube rack            | A1 master mix              |
    |      |                      | A2 wild-type DNA (positive |
    |      |                      |    control)                |
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import groupby
from typing import NamedTuple

from ..rules import Common
from .paired_columns import paired_columns
from .table_words import TableWords
from .tables import FILLER, Entry, Table, join_cells, tables_in
from .tubes_to_rows import tubes_to_rows

_ARROW = re.compile(r"->|→|=>")

_FEWEST = 2
"""Entries that name wells."""


def told_tables(
    line: int, text: str, common: Common, alone: Mapping[str, str]
) -> Iterator[tuple[int, str]]:
    """The text without its tables, and then these in plain lines, each with its first line.

    Tables that read well as they stand stay where they are, and so do those of which it is not
    plain which column is for what.

    Args:
        line: The text's first line.
        text: The text.
        common: Words for labware and slots.
        alone: The one well of each labware that has no more, by its slot.
    """
    lines, words = text.split("\n"), TableWords(common)
    told: list[tuple[int, str]] = []
    for found in _tables(list(lines), words, alone):
        if sum(words.has_wells(entry.said) for entry in found.entries) < _FEWEST:
            continue
        drawn = lines[found.first : found.end]
        lines[found.first : found.end] = [FILLER] * len(drawn)
        for entry in found.entries:  # what a line above the table speaks of
            if not entry.heading:
                written = drawn[entry.at - found.first]
                indent = written[: len(written) - len(written.lstrip())]
                lines[entry.at] = f"{indent}{entry.said}"
        headed = [entry for entry in found.entries if entry.heading]
        told += [(line + at, block) for at, block in _blocks(headed)]
    yield line, "\n".join(lines)
    yield from told


class _Told(NamedTuple):
    """The entries of a table, and from which line up to which it stands."""

    first: int
    end: int
    entries: list[Entry]


def _tables(lines: list[str], words: TableWords, alone: Mapping[str, str]) -> Iterator[_Told]:
    """What can be told of the tables of a text."""
    for table in tables_in(lines, words.names):
        if any(_ARROW.search(cell) for row in table.rows for cell in row.cells):
            continue  # from where, and to where
        kinds = _kinds(table, words)
        if kinds is not None:
            yield _Told(table.first, table.end, [*_entries(table, kinds, words, alone)])
        else:
            yield _Told(table.first, table.end, [*paired_columns(table, words)])
    for entries in tubes_to_rows(lines, words):
        places = [entry.at for entry in entries]
        yield _Told(min(places), max(places) + 1, entries)


def _blocks(entries: list[Entry]) -> Iterator[tuple[int, str]]:
    """The entries under each heading, with the place of the line before the first of them."""
    for heading, under in groupby(entries, key=lambda entry: entry.heading):
        block, first = [heading], -1
        for entry in under:
            first = entry.at - 1 if first < 0 else first
            block += [FILLER] * (entry.at - first - len(block))
            block.append(entry.said)
        yield first, "\n".join(block)


class _Kinds(NamedTuple):
    """The columns of a table: that of slots, of labware, of wells, and those of what these hold.

    Without one of what wells hold, that stands behind them: "A1 master mix".
    """

    slot: int | None
    labware: int | None
    place: int
    contents: list[int]


def _kinds(table: Table, words: TableWords) -> _Kinds | None:
    """The columns of a table, or ``None`` where they are not told apart or need not be."""
    slot = labware = place = None
    contents: list[int] = []
    for at, title in enumerate(table.titles):
        cells = [row.cells[at] for row in table.rows if row.cells[at]]
        if not cells:
            continue
        if slot is None and words.are_slots(title, cells):
            slot = at
        elif place is None and _are_places(table, at, words):
            place = at
        elif any(map(words.has_wells, cells)):
            return None  # from where, and to where
        elif labware is None and all(map(words.says_labware, cells)):
            labware = at
        else:
            contents.append(at)
    apart = slot is not None or labware is not None
    if place is None or not (apart or min(contents, default=place) < place):
        return None
    return _Kinds(slot, labware, place, contents)


def _are_places(table: Table, column: int, words: TableWords) -> bool:
    """Whether the cells of a column begin with wells: two at least, and all that name some, but for
    those that go on with the cell above. Without bars each line says where.
    """
    told = 0
    for row in table.rows:
        cell = row.cells[column]
        place = words.place(cell)
        told += place is not None and bool(place.wells)
        unlike = words.has_wells(cell) and not _hangs(row.cells, column)
        if place is None and (unlike or not table.barred):
            return False
    return told >= _FEWEST


def _hangs(cells: list[str], column: int) -> bool:
    """Whether a line has no more than one cell, as where that goes on with the one above."""
    return not any(cell for at, cell in enumerate(cells) if at != column)


@dataclass
class _Line:
    """What one or several lines of a table say together; ``slot`` and ``labware`` stay until the
    next ones.
    """

    at: int
    slot: str
    labware: list[str]
    cells: list[str]


def _whole(table: Table, kinds: _Kinds, words: TableWords) -> list[_Line]:
    """The lines of a table, those that go on with the one above joined to it."""
    found: list[_Line] = []
    slot, labware = "", list[str]()
    for row in table.rows:
        in_slot = words.slot_in(row.cells[kinds.slot], bare=True) if kinds.slot is not None else ""
        stands = row.cells[kinds.labware] if kinds.labware is not None else ""
        begins = words.place(row.cells[kinds.place]) is not None
        told = any(row.cells[at] for at in kinds.contents) or not kinds.contents
        anew = bool(in_slot) or (begins and told) or not found
        if in_slot or (stands and anew and kinds.slot is None):
            slot, labware = in_slot, []
        if stands:
            labware.append(stands)
        if anew:
            found.append(_Line(row.at, slot, labware, list(row.cells)))
        else:
            join_cells(found[-1].cells, row.cells)
    return found


def _entries(
    table: Table, kinds: _Kinds, words: TableWords, alone: Mapping[str, str]
) -> Iterator[Entry]:
    for line in _whole(table, kinds, words):
        cell = line.cells[kinds.place]
        place = words.place(cell)
        lead, wells, rest = place if place else ("", "", cell)
        slot = words.slot_in(lead)
        heading = lead if slot else ""
        if line.slot:
            slot, heading = line.slot, f"slot {line.slot}"
        if not wells and slot in alone:
            wells = alone[slot]
        if not wells:
            continue
        told = {at: words.with_unit(line.cells[at], table.titles[at]) for at in kinds.contents}
        before = [told[at] for at in kinds.contents if at < kinds.place]
        after = [told[at] for at in kinds.contents if at > kinds.place]
        said = ", ".join(filter(None, (*before, rest, *after)))
        if lead and lead != heading:
            wells = f"{lead} {wells}"
        stands = " ".join(line.labware)
        named = f"{heading}: {stands}".rstrip() if heading else f"{stands}:" if stands else ""
        yield Entry(line.at, named, f"{wells} = {said}" if said else wells)
