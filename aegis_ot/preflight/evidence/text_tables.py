"""Tables written as one text: the work lists and layouts that a LIMS or a spreadsheet exports."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from ...instrumentation import Row, is_spot
from ..layouts import Deck
from ..rules import Common
from ..text import EVERYWHERE, SourceFacts, origins
from .clues import Clue
from .run_maps import clues_of_rows, labware_of_columns, spots_in

_SEPARATORS = (",", ";", r"\|", r"\t+", r"\s{2,}", r"\s+")
_FEWEST_ROWS = 2


Tables = Mapping[str, Sequence[Row]]
"""The rows of each constant that is a table, by its name."""


def read_tables(facts: SourceFacts) -> Tables:
    """Texts of rows, however the run reads them.

    So too literal rows that name wells of two labware, ``("A1", "H12", "NTC")``.
    """
    return {name: rows for name in facts.constants if (rows := _rows(facts, name))}


def written_tables(
    deck: Deck, facts: SourceFacts, common: Common, tables: Tables
) -> Iterator[Clue]:
    """What stands beside the names of wells in tables."""
    for name, rows in tables.items():
        yield from clues_of_rows(deck, facts, common, rows, name, facts.assigned.get(name))


def transfer_lists(deck: Deck, facts: SourceFacts, tables: Tables) -> frozenset[str]:
    """Tables whose rows name wells of two labware: they are no maps of one plate."""
    return frozenset(
        name
        for name, rows in tables.items()
        if len(set(labware_of_columns(deck, facts, rows).values())) > 1
    )


def _rows(facts: SourceFacts, name: str) -> list[Row]:
    value = facts.constants[name]
    if isinstance(value, str):
        titles, cells = _table(value)
    else:
        value = _ungrouped(value)
        titles, cells = (), _transfers(value)
    keyed = isinstance(facts.constants[name], Mapping)
    if cells and not titles:
        titles = _unpacked_to(facts, name, len(cells[0]), keyed)
        titles = titles or [str(at) for at in range(len(cells[0]))]
    elif not cells and (apart := _transfers(value, pairs=True)):
        # `for name, (tube, well) in PLAN.items()`: no list of wells, if the run takes it apart.
        titles = _unpacked_to(facts, name, len(apart[0]), keyed)
        cells = apart if titles else []
    return [Row(tuple(zip(titles, row, strict=True))) for row in cells]


def _ungrouped(value: Any) -> Any:
    """Lists of rows under keys as one list, each row with its key: ``{"TNF": [(1, "B1"), ...]}``.

    Other values as they are.
    """
    if not isinstance(value, Mapping):
        return value
    rows = [(key, row) for key, listed in value.items() if _are_rows(listed) for row in listed]
    whole = all(map(_are_rows, value.values()))
    return [(key, *row) for key, row in rows] if whole and len(rows) > len(value) else value


def _are_rows(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and all(
        isinstance(row, (list, tuple)) and len(row) > 1 for row in value
    )


def _table(text: str) -> tuple[Sequence[str], list[list[Any]]]:
    """Titles, if there are any, and the cells of each row that names a well."""
    lines = [line.strip() for line in text.splitlines()]
    lines = [line for line in lines if line and not line.startswith("#")]
    for separator in _SEPARATORS:
        rows = [[cell.strip() for cell in re.split(separator, line.strip("|"))] for line in lines]
        width = Counter(map(len, rows)).most_common(1)[0][0] if rows else 0
        even = [row for row in rows if len(row) == width]
        placed = [row for row in even if any(map(spots_in, row))]
        if width > 1 and len(placed) >= _FEWEST_ROWS and len(placed) >= len(rows) - 1:
            has_titles = even[0] is rows[0] and even[0] is not placed[0]
            return (even[0] if has_titles else ()), [list[Any](row) for row in placed]
    return (), []


def _transfers(value: Any, pairs: bool = False) -> list[list[Any]]:
    """The cells of literal rows, if two columns of them or more hold the names of wells.

    Several wells in brackets are one cell, or as many, if these are ``pairs``.
    """
    if isinstance(value, Mapping):
        value = list(value.items())
    if not isinstance(value, (list, tuple)) or len(value) < _FEWEST_ROWS:
        return []
    if not all(isinstance(row, (list, tuple)) for row in value):
        return []
    rows = [list(_flat(row, pairs)) for row in value]
    even = all(len(row) == len(rows[0]) for row in rows)
    columns = list(zip(*rows, strict=True)) if even else []
    placed = [column for column in columns if all(spots_in(cell) for cell in column)]
    return rows if len(placed) > 1 else []


def _flat(row: Iterable[Any], pairs: bool) -> Iterator[Any]:
    for cell in row:
        if isinstance(cell, (list, tuple)) and (pairs or not all(map(is_spot, cell))):
            yield from _flat(cell, pairs)
        else:
            yield " ".join(cell) if isinstance(cell, (list, tuple)) else cell


def _unpacked_to(facts: SourceFacts, name: str, width: int, keyed: bool) -> Sequence[str]:
    """What the run calls the columns where it takes the rows apart, if it does.

    Of a dict the key may be left out: ``for tube, wells in TREATMENTS.values()``.
    """
    for names in facts.unpacked:
        whole = len(names) == width or (keyed and len(names) + 1 == width)
        if whole and name in origins(facts, names, EVERYWHERE):
            return (*("0",) * (width - len(names)), *names)
    return ()
