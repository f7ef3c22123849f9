"""Work lists: rows that say by its label where a well stands, ``("SP-7", "A4", "B1")``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...instrumentation import is_spot
from .deck import Deck


def is_work_list(deck: Deck, value: Any) -> bool:
    """Whether each row of a constant names a labware and a well."""
    if not isinstance(value, (list, tuple)) or len(value) < 2:
        return False
    return all(_names_a_place(deck, row) for row in value)


def _names_a_place(deck: Deck, row: Any) -> bool:
    if isinstance(row, Mapping):
        row = tuple(row.values())
    if not isinstance(row, (list, tuple)):
        return False
    return any(map(is_spot, row)) and any(labware_in(deck, cell) for cell in row)


def labware_in(deck: Deck, cell: Any) -> str:
    """The labware that a cell calls by its label: the next well of the row stands in it."""
    if not isinstance(cell, str) or is_spot(cell):
        return ""
    called = deck.by_label.get(cell.strip(), set())
    return next(iter(called)) if len(called) == 1 else ""
