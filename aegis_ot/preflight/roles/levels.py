"""The concentration or dose that a clue gives a well."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

from ..rules import Common
from ..text import direction_in, level_in, numbers_in_order
from .clues import Clue


def level_of(clue: Clue, position: int, common: Common) -> float | None:
    """Level that a clue gives its well number ``position``, or ``None``."""
    if clue.levels and position < len(clue.levels):
        return clue.levels[position]
    count = len(clue.wells)
    listed = numbers_in_order(clue.text) if count > 1 else []
    if count > 1 and len(listed) == count and len(set(listed)) == count:
        return listed[position]
    if count > 1 and not clue.whole:
        direction = direction_in(clue.text, common)
        if direction:
            return float(direction * position)
    if count > 1 and not _one_value(clue):
        return None
    return level_in(clue.text, common, plain_numbers=clue.subject)


def _one_value(clue: Clue) -> bool:
    """Whether one level may hold for all wells of the clue: replicates, a column."""
    return not clue.whole


def is_number(value: Any) -> bool:
    """Whether a value of the protocol is a number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def number_in(value: Any) -> float | None:
    """The number that a value of the protocol is, or that its text says."""
    if is_number(value):
        return float(value)
    if isinstance(value, str):
        with suppress(ValueError):
            return float(value)
    return None
