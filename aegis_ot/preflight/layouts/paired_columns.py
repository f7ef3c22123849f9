"""Tables whose columns are labware, and whose lines are what stands in all of these::

             tubes (slot 5)        plate (slot 6)
blank        A1                    A1
standard     A2 0.25, A3 0.5,      B1, C1,
             A4 1.0 mg/mL          D1
samples      B1 ... B5             A3 ... E3
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from .table_words import NUMBER, TableWords
from .tables import Entry, Table, join_cells

_FEWEST = 2


class _Item(NamedTuple):
    """Wells of a cell, and what the cell says behind them."""

    wells: str
    said: str


def paired_columns(table: Table, words: TableWords) -> Iterator[Entry]:
    """What each such labware holds where, if a column beside theirs says it.

    Wells with nothing behind them hold in turn what another labware's wells are said to hold, if
    these are as many: C1 0.5 mg/mL.
    """
    labware = [
        at
        for at, title in enumerate(table.titles)
        if words.says_labware(title) and any(words.has_wells(row.cells[at]) for row in table.rows)
    ]
    others = [at for at in range(len(table.titles)) if at not in labware]
    if len(labware) < _FEWEST or len(others) != 1:
        return
    labels = [row.cells[others[0]] for row in table.rows]
    if any(words.has_wells(cell) or NUMBER.fullmatch(cell) for cell in labels):
        return
    lines = _whole(table, others[0])
    told = [_told_in_turn([_items(cells[at], words) for at in labware]) for _, cells in lines]
    for at, by_line in zip(labware, zip(*told, strict=True), strict=True):
        for (line, cells), items in zip(lines, by_line, strict=True):
            said = "; ".join(
                f"{item.wells} = {cells[others[0]]} {item.said}".strip() for item in items
            )
            if items:
                yield Entry(line, f"{table.titles[at]}:", said)


def _whole(table: Table, label: int) -> list[tuple[int, list[str]]]:
    """The lines of a table with their places; one without a label goes on with the one above."""
    found: list[tuple[int, list[str]]] = []
    for row in table.rows:
        if row.cells[label] or not found:
            found.append((row.at, list(row.cells)))
        else:
            join_cells(found[-1][1], row.cells)
    return found


def _items(cell: str, words: TableWords) -> list[_Item]:
    """The wells of a cell, each with what stands behind them: "A2 0.25, A3 0.5 mg/mL".

    The unit of the last number is that of all.
    """
    cell = words.without_dots(cell)
    found = list(words.names.spec.finditer(cell))
    if not found:
        return []  # "-", "all"
    ends = [match.start() for match in found[1:]] + [len(cell)]
    items = [
        _Item(match.group(), cell[match.end() : end].strip(" ,;:="))
        for match, end in zip(found, ends, strict=True)
    ]
    unit = NUMBER.sub("", items[-1].said, count=1) if items else ""
    numbers = [item.said for item in items[:-1]]
    if unit.strip() and numbers and all(map(NUMBER.fullmatch, numbers)):
        items = [_Item(i.wells, i.said + unit) for i in items[:-1]] + items[-1:]
    return items


def _told_in_turn(columns: list[list[_Item]]) -> list[list[_Item]]:
    """The items of one line, those that say nothing with what as many in another column say."""
    told = next((items for items in columns if any(item.said for item in items)), [])
    return [
        [_Item(item.wells, other.said) for item, other in zip(items, told, strict=True)]
        if len(items) == len(told) and not any(item.said for item in items)
        else items
        for items in columns
    ]
