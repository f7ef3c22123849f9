"""Work lists: rows that say in which labware a well stands, ``("SP-7", "A4", "B1")``."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import permutations
from typing import Any

from ...instrumentation import is_spot
from ...vocabulary import WellRef
from .deck import Deck
from .well_names import plain_name


def is_work_list(deck: Deck, value: Any) -> bool:
    """Whether each row of a constant names a labware and a well."""
    if not isinstance(value, (list, tuple)) or len(value) < 2:
        return False
    rows = [tuple(row.values()) if isinstance(row, Mapping) else row for row in value]
    if not all(isinstance(row, (list, tuple)) and any(map(is_spot, row)) for row in rows):
        return False
    keyed = labware_by_key(deck, [list(enumerate(row)) for row in rows])
    return all(any(labware_in(deck, cell) for cell in row) for row in rows) or bool(keyed)


def labware_in(deck: Deck, cell: Any) -> str:
    """The labware that a cell calls by its label: the next well of the row stands in it."""
    if not isinstance(cell, str) or is_spot(cell):
        return ""
    called = deck.by_label.get(cell.strip(), set())
    return next(iter(called)) if len(called) == 1 else ""


def labware_by_key(
    deck: Deck, rows: Sequence[Iterable[tuple[Any, Any]]]
) -> dict[Any, Mapping[str, str]]:
    """Columns whose cells are all keys of one dict of labware, ``plates[2]``, with that dict.

    Args:
        deck: For the labware that dicts of the run held.
        rows: Each row's cells, as ``(column, cell)``.
    """
    columns: dict[Any, set[str]] = {}
    for row in rows:
        for column, cell in row:
            columns.setdefault(column, set()).add(str(cell))
    return {
        column: held
        for column, cells in columns.items()
        for held in deck.keyed.values()
        if len(cells) > 1 and cells <= held.keys()
    }


def drawn_and_filled(deck: Deck, keys: Collection[str], spots: Iterable[str]) -> list[WellRef]:
    """The wells of one row that the run draws from and fills: ``("D1", "G4", "G5")``, a tube and
    where it goes. None unless each of the row's places is one or the other, and only so.

    Args:
        deck: For the run.
        keys: Labware that the run takes the row's places for.
        spots: Names of wells.
    """
    names = set(map(plain_name, spots))
    for one, other in permutations(sorted(keys), 2) if len(names) > 1 else ():
        into = {
            source: {well for well in wells if well.labware == other}
            for source, wells in deck.served.items()
            if source.labware == one
        }
        drawn = {
            source: wells
            for source, wells in into.items()
            if source.name in names and wells and all(well.name in names for well in wells)
        }
        filled = {well for wells in drawn.values() for well in wells}
        alone = all(
            source in drawn for source, wells in into.items() if not wells.isdisjoint(filled)
        )
        if alone and names == {ref.name for ref in (*drawn, *filled)}:
            return [*drawn, *sorted(filled, key=lambda ref: ref.name)]
    return []
